#include "render/picture_samples.h"

#include "core/srgb.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

Rgb rgb_from_yuv(int y, int u, int v) {
  const float l = 1.16438F * static_cast<float>(y - 16), cu = static_cast<float>(u - 128),
              cv = static_cast<float>(v - 128);
  const auto level = [](float value) { return std::clamp(value / 255, 0.0F, 1.0F); };
  return {level(l + 1.59603F * cv), level(l - 0.39176F * cu - 0.81297F * cv), level(l + 2.01723F * cu)};
}

const std::uint8_t* row_of(const Picture& p, std::size_t plane, int y) {
  return p.planes[plane] + p.strides[plane] * static_cast<std::size_t>(y);
}

}  // namespace

Rgb coded_at(const Picture& p, int x, int y) {
  const std::uint8_t* row = row_of(p, 0, y);
  switch (p.format) {
    case PixelFormat::rgb8: {
      const auto level = [row, x](int c) { return static_cast<float>(row[3 * x + c]) / 255; };
      return {level(0), level(1), level(2)};
    }
    case PixelFormat::gray8: {
      const float level = static_cast<float>(row[x]) / 255;
      return {level, level, level};
    }
    case PixelFormat::nv12: {
      const std::uint8_t* chroma = row_of(p, 1, y / 2) + x / 2 * 2;
      return rgb_from_yuv(row[x], chroma[0], chroma[1]);
    }
    case PixelFormat::yuyv: {
      const std::uint8_t* pair = row + x / 2 * 4;
      return rgb_from_yuv(pair[x % 2 * 2], pair[1], pair[3]);
    }
  }
  return {};
}

int brightness_at(const Picture& p, int x, int y) {
  const std::uint8_t* row = row_of(p, 0, y);
  switch (p.format) {
    case PixelFormat::rgb8:
      return row[3 * x + 1];
    case PixelFormat::yuyv:
      return row[2 * x];
    case PixelFormat::gray8:
    case PixelFormat::nv12:
      break;
  }
  return row[x];
}

Rgb linear_of(const Rgb& coded) {
  return {linear_from_srgb(coded[0]), linear_from_srgb(coded[1]), linear_from_srgb(coded[2])};
}

float noise_of(const Picture& p) {
  constexpr int columns = 24, rows = 16;
  if (p.width < 3 * columns || p.height < 3 * rows) return 0;
  std::array<int, std::size_t{columns} * rows> strengths;
  std::size_t count = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int x = 1 + (p.width - 3) * column / (columns - 1), y = 1 + (p.height - 3) * row / (rows - 1);
      const auto at = [&](int dx, int dy) { return brightness_at(p, x + dx, y + dy); };
      strengths[count++] = std::abs(4 * at(0, 0) - 2 * (at(-1, 0) + at(1, 0) + at(0, -1) + at(0, 1)) + at(-1, -1) +
                                    at(1, -1) + at(-1, 1) + at(1, 1));
    }
  const auto middle = strengths.begin() + count / 2;
  std::nth_element(strengths.begin(), middle, strengths.end());
  // The mask's weights have a root sum of squares of 6; a normal distribution's median lies at 0.6745 deviations.
  return static_cast<float>(*middle) / (6 * 0.6745F * 255);
}

}  // namespace onestroke
