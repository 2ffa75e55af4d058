#pragma once

#include "tracking/image_view.h"

#include <opencv2/core/hal/intrin.hpp>

#include <cstring>

namespace onestroke {

/// Red, green and blue in one vector, and a fourth lane that means nothing.
using ColorLanes = cv::v_float32x4;

/// ImageView::sample, all channels at once; its scalar twin to the last bit.
inline ColorLanes sample_lanes(const ImageView& image, double u, double v) {
  const double x = u - 0.5, y = v - 0.5;
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  // A pixel is read with the byte after it, and after the picture's last one there may be none.
  if (x0 + 2 >= image.width && y0 + 2 >= image.height) {
    const Color c = image.sample(u, v);
    return {c[0], c[1], c[2], 0};
  }
  const std::uint8_t* p = image.at(x0, y0);
  const std::uint8_t* q = p + image.stride;
  // OpenCV reads the four bytes as one int, which must lie on a boundary of four.
  const auto pixel = [](const std::uint8_t* at) {
    alignas(int) std::uint8_t aligned[4];
    std::memcpy(aligned, at, sizeof aligned);
    return cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_load_expand_q(aligned)));
  };
  const ColorLanes fx = cv::v_setall_f32(static_cast<float>(x - x0)), fy = cv::v_setall_f32(static_cast<float>(y - y0));
  const ColorLanes p0 = pixel(p), q0 = pixel(q);
  const ColorLanes above = p0 + fx * (pixel(p + 3) - p0), below = q0 + fx * (pixel(q + 3) - q0);
  return above + fy * (below - above);
}

inline Color to_color(const ColorLanes& lanes) {
  float c[4];
  cv::v_store(c, lanes);
  return {c[0], c[1], c[2]};
}

}  // namespace onestroke
