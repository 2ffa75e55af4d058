#include "camera/softening.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

void Softening::set(double sigma) {
  if (sigma == sigma_) return;
  sigma_ = sigma;
  const int reach = std::max(1, static_cast<int>(std::ceil(3 * sigma)));
  weights_.assign(static_cast<std::size_t>(reach) + 1, 0.0f);
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    const double w = std::exp(-0.5 * i * i / (sigma * sigma));
    weights_[static_cast<std::size_t>(i)] = static_cast<float>(w);
    sum += i == 0 ? w : 2 * w;
  }
  for (float& w : weights_) w = static_cast<float>(w / sum);
}

void Softening::along(float* row, std::size_t n, float* scratch) const {
  std::copy(row, row + 4 * n, scratch);
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(n) - 1;
  for (std::ptrdiff_t x = 0; x <= last; ++x) {
    float sum[4];
    for (int c = 0; c < 4; ++c) sum[c] = weights_[0] * scratch[4 * x + c];
    for (std::size_t k = 1; k < weights_.size(); ++k) {
      const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(k);
      const float* a = scratch + 4 * std::max<std::ptrdiff_t>(x - i, 0);
      const float* b = scratch + 4 * std::min(x + i, last);
      for (int c = 0; c < 4; ++c) sum[c] += weights_[k] * (a[c] + b[c]);
    }
    std::copy(sum, sum + 4, row + 4 * x);
  }
}

void Softening::across(const float* picture, std::size_t floats, int height, int row, float* out) const {
  const auto line = [&](int y) { return picture + static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * floats; };
  const float* middle = line(row);
  for (std::size_t i = 0; i < floats; ++i) out[i] = weights_[0] * middle[i];
  for (std::size_t k = 1; k < weights_.size(); ++k) {
    const float* a = line(row - static_cast<int>(k));
    const float* b = line(row + static_cast<int>(k));
    for (std::size_t i = 0; i < floats; ++i) out[i] += weights_[k] * (a[i] + b[i]);
  }
}

}  // namespace onestroke
