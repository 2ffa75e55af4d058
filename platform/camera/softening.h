#pragma once

#include <cstddef>
#include <vector>

namespace onestroke {

/// A Gaussian blur of pictures of four floats a pixel, edges repeated.
class Softening {
 public:
  /// Standard deviation in pixels; cheap where it stays the same.
  void set(double sigma);
  /// Blurs a row of n pixels in place; scratch holds as many.
  void along(float* row, std::size_t n, float* scratch) const;
  /// Blurs down the columns: one row of `floats` values out of a picture of such rows.
  void across(const float* picture, std::size_t floats, int height, int row, float* out) const;

 private:
  double sigma_ = -1;
  std::vector<float> weights_;  ///< From the middle outwards.
};

}  // namespace onestroke
