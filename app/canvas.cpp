#include "app/canvas.h"

#include "render/font.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

std::uint8_t level(double v) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0, 255.0)));
}

Rgb from_yuv(std::uint8_t y, std::uint8_t u, std::uint8_t v) {
  const double l = 1.164 * (y - 16), b = u - 128.0, r = v - 128.0;
  return {level(l + 1.596 * r), level(l - 0.392 * b - 0.813 * r), level(l + 2.017 * b)};
}

Rgb pixel(const Picture& p, int x, int y) {
  const std::uint8_t* row = p.planes[0] + static_cast<std::size_t>(y) * p.strides[0];
  const int even = x / 2 * 2;
  switch (p.format) {
    case PixelFormat::rgb8:
      return {row[3 * x], row[3 * x + 1], row[3 * x + 2]};
    case PixelFormat::gray8:
      return {row[x], row[x], row[x]};
    case PixelFormat::nv12: {
      const std::uint8_t* colors = p.planes[1] + static_cast<std::size_t>(y / 2) * p.strides[1];
      return from_yuv(row[x], colors[even], colors[even + 1]);
    }
    case PixelFormat::yuyv:
      return from_yuv(row[2 * x], row[2 * even + 1], row[2 * even + 3]);
  }
  return {};
}

/// How much of a pixel lies within an edge that is so far outside (negative: inside) of its centre.
double inside(double distance) {
  return std::clamp(0.5 - distance, 0.0, 1.0);
}

/// The share of a pixel that a glyph inks: u, v at the pixel's centre and their steps to the next pixel.
double glyph_coverage(double u, double v, double step_u, double step_v) {
  const FontAtlas& atlas = font_atlas();
  constexpr std::array<double, 4> at{-0.375, -0.125, 0.125, 0.375};
  const auto texel = [&](int x, int y) {
    x = std::clamp(x, 0, atlas.width - 1);
    y = std::clamp(y, 0, atlas.height - 1);
    return static_cast<double>(atlas.texels[static_cast<std::size_t>(y * atlas.width + x)]);
  };
  int inked = 0;
  for (const double dy : at)
    for (const double dx : at) {
      const double x = (u + dx * step_u) * atlas.width - 0.5, y = (v + dy * step_v) * atlas.height - 0.5;
      const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
      const double fx = x - x0, fy = y - y0;
      const double upper = (1 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
      const double lower = (1 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
      inked += (1 - fy) * upper + fy * lower > 127.5;
    }
  return inked / 16.0;
}

}  // namespace

Canvas::Canvas(const Picture& picture)
    : width_(picture.width),
      height_(picture.height),
      rgba_(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
  std::uint8_t* to = rgba_.data();
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x, to += 4) {
      const Rgb rgb = pixel(picture, x, y);
      std::copy(rgb.begin(), rgb.end(), to);
      to[3] = 255;
    }
}

template <typename Coverage>
void Canvas::cover(double left, double top, double right, double bottom, Ink ink, Coverage&& coverage) {
  if (!(left < width_ && top < height_ && right > 0 && bottom > 0)) return;
  const int x0 = static_cast<int>(std::max(0.0, left)), x1 = static_cast<int>(std::min(width_ - 1.0, right));
  const int y0 = static_cast<int>(std::max(0.0, top)), y1 = static_cast<int>(std::min(height_ - 1.0, bottom));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double share = ink.opacity * coverage(x + 0.5, y + 0.5);
      if (share <= 0) continue;
      std::uint8_t* to = rgba_.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                             static_cast<std::size_t>(x));
      to[0] = level(to[0] + share * (ink.r - to[0]));
      to[1] = level(to[1] + share * (ink.g - to[1]));
      to[2] = level(to[2] + share * (ink.b - to[2]));
    }
}

void Canvas::line(double x0, double y0, double x1, double y1, double line_width, Ink ink) {
  const double dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy, half = line_width / 2, edge = half + 1;
  cover(std::min(x0, x1) - edge, std::min(y0, y1) - edge, std::max(x0, x1) + edge, std::max(y0, y1) + edge, ink,
        [&](double x, double y) {
          const double u = square > 0 ? std::clamp(((x - x0) * dx + (y - y0) * dy) / square, 0.0, 1.0) : 0;
          return inside(std::hypot(x - x0 - u * dx, y - y0 - u * dy) - half);
        });
}

void Canvas::dot(double x, double y, double radius, Ink ink) {
  line(x, y, x, y, 2 * radius, ink);
}

void Canvas::box(double left, double top, double right, double bottom, Ink ink) {
  cover(left - 1, top - 1, right + 1, bottom + 1, ink, [&](double x, double y) {
    return inside(std::max(left - x, x - right)) * inside(std::max(top - y, y - bottom));
  });
}

void Canvas::text(double left, double top, double height, std::string_view words, Ink ink) {
  lay_out(words, [&](const Glyph& g, float pen_x, float pen_y) {
    const double x0 = left + height * (pen_x + g.left), x1 = left + height * (pen_x + g.right);
    const double y0 = top + height * (pen_y + g.top), y1 = top + height * (pen_y + g.bottom);
    const double step_u = (g.u1 - g.u0) / (x1 - x0), step_v = (g.v1 - g.v0) / (y1 - y0);
    cover(x0, y0, x1, y1, ink, [&](double x, double y) {
      if (x < x0 || x > x1 || y < y0 || y > y1) return 0.0;
      return glyph_coverage(g.u0 + (x - x0) * step_u, g.v0 + (y - y0) * step_v, step_u, step_v);
    });
  });
}

double Canvas::text_width(double height, std::string_view words) {
  return height * static_cast<double>(measure(words).width);
}

}  // namespace onestroke
