#pragma once

#include "camera/capture.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace onestroke::test {

/// BT.601, limited range: what cameras mean by YUV.
struct Yuv {
  double y, u, v;
};
inline Yuv yuv_of(const std::uint8_t* rgb) {
  const double r = rgb[0], g = rgb[1], b = rgb[2];
  return {16 + 0.257 * r + 0.504 * g + 0.098 * b, 128 - 0.148 * r - 0.291 * g + 0.439 * b,
          128 + 0.439 * r - 0.368 * g - 0.071 * b};
}

inline std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// A packed rgb8 picture of even width and height as a device would send it.
inline std::vector<std::uint8_t> coded(const std::uint8_t* rgb, PictureSize size, CaptureCoding coding) {
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  const auto at = [&](std::size_t x, std::size_t y) { return rgb + 3 * (y * width + x); };
  std::vector<std::uint8_t> bytes;
  switch (coding) {
    case CaptureCoding::mjpeg: {
      cv::Mat bgr;
      cv::cvtColor(cv::Mat(size.height, size.width, CV_8UC3, const_cast<std::uint8_t*>(rgb)), bgr, cv::COLOR_RGB2BGR);
      cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
      break;
    }
    case CaptureCoding::yuyv:
      for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; x += 2) {
          const Yuv left = yuv_of(at(x, y)), right = yuv_of(at(x + 1, y));
          for (const double value : {left.y, (left.u + right.u) / 2, right.y, (left.v + right.v) / 2})
            bytes.push_back(byte_of(value));
        }
      break;
    case CaptureCoding::nv12:
      for (std::size_t i = 0; i < width * height; ++i) bytes.push_back(byte_of(yuv_of(rgb + 3 * i).y));
      for (std::size_t y = 0; y < height; y += 2)
        for (std::size_t x = 0; x < width; x += 2) {
          double u = 0, v = 0;
          for (const std::uint8_t* pixel : {at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)}) {
            u += yuv_of(pixel).u / 4;
            v += yuv_of(pixel).v / 4;
          }
          bytes.push_back(byte_of(u));
          bytes.push_back(byte_of(v));
        }
      break;
    case CaptureCoding::rgb8:
    case CaptureCoding::bgr8:
      bytes.assign(rgb, rgb + 3 * width * height);
      for (std::size_t i = 0; coding == CaptureCoding::bgr8 && i < bytes.size(); i += 3)
        std::swap(bytes[i], bytes[i + 2]);
      break;
  }
  return bytes;
}

/// As a device lays out what coded() makes.
inline CaptureFormat format_of(PictureSize size, CaptureCoding coding) {
  const auto width = static_cast<std::size_t>(size.width);
  const std::size_t bytes = coding == CaptureCoding::yuyv ? 2 : coding == CaptureCoding::nv12 ? 1 : 3;
  return {.coding = coding, .size = size, .strides = {bytes * width, coding == CaptureCoding::nv12 ? width : 0}};
}

}  // namespace onestroke::test
