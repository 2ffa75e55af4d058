#include "tracking/segmentation.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace onestroke {

void segment(const ImageView& image, const SegmentationOptions& options, std::vector<std::uint8_t>& labels) {
  labels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  // Fixed point, 8 fractional bits: the comparison runs once per pixel and gain.
  const int gain = static_cast<int>(256 * options.blue_gain + 0.5F);
  const int relative = static_cast<int>(256 * options.relative_margin + 0.5F);
  const int absolute = static_cast<int>(256 * options.absolute_margin + 0.5F);
  std::uint8_t* out = labels.data();
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* p = image.at(0, y);
    for (int x = 0; x < image.width; ++x, p += 3) {
      const int r = 256 * p[0], g = 256 * p[1], b = gain * p[2];
      const int high = std::max({r, g, b});
      const int middle = std::max(std::min(r, g), std::min(std::max(r, g), b));
      const int needed = std::max(absolute, (high >> 8) * relative);
      const std::uint8_t best = high == r ? 0 : (high == g ? 1 : 2);
      *out++ = high - middle >= needed ? best : no_ink;
    }
  }
}

void smooth(const ImageView& image, double sigma, std::vector<std::uint8_t>& out) {
  out.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const cv::Mat source(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.data), image.stride);
  cv::Mat target(image.height, image.width, CV_8UC3, out.data());
  cv::GaussianBlur(source, target, cv::Size(), sigma);
}

}  // namespace onestroke
