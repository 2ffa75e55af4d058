#include "tracking/segmentation.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace onestroke {
namespace {

// Fixed point, 8 fractional bits: the comparison runs once per pixel and gain.
class InkTest {
 public:
  explicit InkTest(const SegmentationOptions& options)
      : red_gain_(static_cast<int>(256 * options.red_gain + 0.5F)),
        blue_gain_(static_cast<int>(256 * options.blue_gain + 0.5F)),
        relative_(static_cast<int>(256 * options.relative_margin + 0.5F)),
        absolute_(static_cast<int>(256 * options.absolute_margin + 0.5F)) {}

  std::uint8_t operator()(int red, int green, int blue) const {
    const int r = red_gain_ * red, g = 256 * green, b = blue_gain_ * blue;
    const int high = std::max({r, g, b});
    const int middle = std::max(std::min(r, g), std::min(std::max(r, g), b));
    const int needed = std::max(absolute_, (high >> 8) * relative_);
    const std::uint8_t best = high == r ? 0 : (high == g ? 1 : 2);
    return high - middle >= needed ? best : no_ink;
  }

 private:
  int red_gain_, blue_gain_, relative_, absolute_;
};

}  // namespace

void segment(const ImageView& image, const SegmentationOptions& options, std::vector<std::uint8_t>& labels,
             int factor) {
  const InkTest ink(options);
  const int width = image.width / factor, height = image.height / factor;
  labels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::uint8_t* out = labels.data();
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* p = image.at(factor / 2, y * factor + factor / 2);
    for (int x = 0; x < width; ++x, p += 3 * factor) *out++ = ink(p[0], p[1], p[2]);
  }
}

void smooth(const ImageView& image, double sigma, std::vector<std::uint8_t>& out) {
  out.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const cv::Mat source(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.data), image.stride);
  cv::Mat target(image.height, image.width, CV_8UC3, out.data());
  cv::GaussianBlur(source, target, cv::Size(), sigma);
}

}  // namespace onestroke
