#include "tracking/rgb_image.h"

#include <opencv2/imgproc.hpp>

namespace onestroke {
namespace {

cv::Mat plane(const Picture& p, std::size_t i, int height, int width, int type) {
  return {height, width, type, const_cast<std::uint8_t*>(p.planes[i]), p.strides[i]};
}

}  // namespace

ImageView rgb_view(const Picture& p, std::vector<std::uint8_t>& storage) {
  if (p.format == PixelFormat::rgb8) return {p.planes[0], p.width, p.height, p.strides[0]};
  const std::size_t stride = 3 * static_cast<std::size_t>(p.width);
  storage.resize(stride * static_cast<std::size_t>(p.height));
  cv::Mat rgb(p.height, p.width, CV_8UC3, storage.data(), stride);
  switch (p.format) {
    case PixelFormat::rgb8:
      break;
    case PixelFormat::gray8:
      cv::cvtColor(plane(p, 0, p.height, p.width, CV_8UC1), rgb, cv::COLOR_GRAY2RGB);
      break;
    case PixelFormat::yuyv:
      cv::cvtColor(plane(p, 0, p.height, p.width, CV_8UC2), rgb, cv::COLOR_YUV2RGB_YUYV);
      break;
    case PixelFormat::nv12:
      cv::cvtColorTwoPlane(plane(p, 0, p.height, p.width, CV_8UC1), plane(p, 1, p.height / 2, p.width / 2, CV_8UC2),
                           rgb, cv::COLOR_YUV2RGB_NV12);
      break;
  }
  return {storage.data(), p.width, p.height, stride};
}

}  // namespace onestroke
