#pragma once

#include "tracking/pixel_run.h"

#include <opencv2/core.hpp>

#include <span>
#include <vector>

namespace onestroke {

/// Spreads each pixel evenly over a disc, as defocus does; the disc's rim is smooth over a pixel. By sums along the
/// rows of the disc, so that it costs a disc's height a pixel, not its area. Keeps its buffers from call to call; used
/// by one thread.
class DiscBlur {
 public:
  /// `from`: CV_32FC4, its edges repeated; `to`: of the same size, blurred in `where`, 0 elsewhere; `sigma`: the disc's
  /// standard deviation along an axis, half its radius, pixels.
  void blur(const cv::Mat& from, double sigma, std::span<const PixelRun> where, cv::Mat& to);

 private:
  // A row of the disc, dy below or above its middle: whole to `whole` pixels from its middle (-1: nowhere), then parts.
  struct Row {
    int dy = 0, whole = -1;
    std::vector<float> parts;
  };
  void lay_out(double radius);
  void sum_rows(const cv::Mat& from);

  int reach_ = 0;
  float scale_ = 1;
  std::vector<Row> rows_;
  cv::Mat padded_, sums_;
};

}  // namespace onestroke
