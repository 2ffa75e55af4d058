#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace onestroke {

using Color = Eigen::Array3f;  ///< Red, green, blue, 0..255 as the camera coded them.

/// Rows of packed 8-bit RGB, borrowed.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0, height = 0;
  std::size_t stride = 0;

  const std::uint8_t* at(int x, int y) const {
    return data + static_cast<std::size_t>(y) * stride + 3 * static_cast<std::size_t>(x);
  }

  /// True where a bilinear sample at (u, v) has its four pixels. Pixel centres at half-integers.
  bool contains(double u, double v) const { return u >= 0.5 && v >= 0.5 && u < width - 0.5 && v < height - 0.5; }

  /// Bilinear sample; contains(u, v) must hold.
  Color sample(double u, double v) const {
    const double x = u - 0.5, y = v - 0.5;
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
    const std::uint8_t* p = at(x0, y0);
    const std::uint8_t* q = p + (y0 + 1 < height ? stride : 0);
    const int right = x0 + 1 < width ? 3 : 0;
    Color c;
    for (int i = 0; i < 3; ++i) {
      const auto p0 = static_cast<float>(p[i]), q0 = static_cast<float>(q[i]);
      const float above = p0 + fx * (static_cast<float>(p[right + i]) - p0);
      const float below = q0 + fx * (static_cast<float>(q[right + i]) - q0);
      c[i] = above + fy * (below - above);
    }
    return c;
  }
};

/// Share of each channel, so that shading drops out: components sum to 1.
inline Color chromaticity(const Color& c) {
  return c / (c.sum() + 1e-3F);
}

}  // namespace onestroke
