#include "tracking/disc_blur.h"

#include <opencv2/core/hal/intrin.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

using cv::v_float32x4;

// How much of a pixel, `x` and `y` from the middle, the disc covers.
float covered(double radius, int x, int y) {
  return static_cast<float>(std::clamp(radius + 0.5 - std::hypot(x, y), 0.0, 1.0));
}

v_float32x4 at(const float* row, int x) {
  return cv::v_load(row + 4 * static_cast<std::ptrdiff_t>(x));
}

}  // namespace

void DiscBlur::blur(const cv::Mat& from, double sigma, std::span<const PixelRun> where, cv::Mat& to) {
  lay_out(2 * sigma);
  sum_rows(from);
  to.create(from.rows, from.cols, CV_32FC4);
  to.setTo(0);
  const v_float32x4 scale = cv::v_setall_f32(scale_);
  for (const PixelRun& run : where) {
    float* out = to.ptr<float>(run.y);
    for (const Row& row : rows_) {
      const int y = std::clamp(run.y + row.dy, 0, from.rows - 1);
      const float *pixels = padded_.ptr<float>(y), *sums = sums_.ptr<float>(y);
      const int parts = static_cast<int>(row.parts.size());
      for (int x = run.x0; x < run.x1; ++x) {
        v_float32x4 sum = at(out, x);
        if (row.whole >= 0) sum += at(sums, x + reach_ + row.whole + 1) - at(sums, x + reach_ - row.whole);
        for (int i = 0; i < parts; ++i) {
          const int away = row.whole + 1 + i;
          const v_float32x4 part = cv::v_setall_f32(row.parts[static_cast<std::size_t>(i)]);
          sum = cv::v_fma(part, at(pixels, x + reach_ - away), sum);
          if (away > 0) sum = cv::v_fma(part, at(pixels, x + reach_ + away), sum);
        }
        cv::v_store(out + 4 * static_cast<std::ptrdiff_t>(x), sum);
      }
    }
    for (int x = run.x0; x < run.x1; ++x) cv::v_store(out + 4 * static_cast<std::ptrdiff_t>(x), at(out, x) * scale);
  }
}

void DiscBlur::lay_out(double radius) {
  reach_ = static_cast<int>(std::ceil(radius));
  rows_.clear();
  float total = 0;
  for (int y = -reach_; y <= reach_; ++y) {
    Row row{y, -1, {}};
    for (int x = 0; x <= reach_; ++x) {
      const float share = covered(radius, x, y);
      total += x == 0 ? share : 2 * share;
      if (share == 1)
        row.whole = x;
      else if (share > 0)
        row.parts.push_back(share);
    }
    if (row.whole >= 0 || !row.parts.empty()) rows_.push_back(std::move(row));
  }
  scale_ = 1 / total;
}

// Each row's pixels with its edges repeated, and the sums of all that come before each.
void DiscBlur::sum_rows(const cv::Mat& from) {
  const int width = from.cols + 2 * reach_;
  padded_.create(from.rows, width, CV_32FC4);
  sums_.create(from.rows, width + 1, CV_32FC4);
  for (int y = 0; y < from.rows; ++y) {
    const float* in = from.ptr<float>(y);
    float *pixels = padded_.ptr<float>(y), *sums = sums_.ptr<float>(y);
    v_float32x4 sum = cv::v_setzero_f32();
    for (int x = 0; x < width; ++x) {
      const v_float32x4 pixel = at(in, std::clamp(x - reach_, 0, from.cols - 1));
      cv::v_store(pixels + 4 * static_cast<std::ptrdiff_t>(x), pixel);
      cv::v_store(sums + 4 * static_cast<std::ptrdiff_t>(x), sum);
      sum += pixel;
    }
    cv::v_store(sums + 4 * static_cast<std::ptrdiff_t>(width), sum);
  }
}

}  // namespace onestroke
