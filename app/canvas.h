#pragma once

#include "core/picture.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace onestroke {

/// Red, green, blue as the picture codes them, and opacity from 0 to 1.
struct Ink {
  std::uint8_t r = 255, g = 255, b = 255;
  double opacity = 1;
};

/// A picture to draw on. Pixels with centres at half-integers; what lies outside is cut off. Edges are smooth.
class Canvas {
 public:
  /// A copy of the picture (NV12 and YUYV: BT.601, limited range).
  explicit Canvas(const Picture& picture);

  int width() const { return width_; }
  int height() const { return height_; }
  /// RGBA rows from the top, without padding.
  std::span<const std::uint8_t> rgba() const { return rgba_; }

  void line(double x0, double y0, double x1, double y1, double line_width, Ink ink);
  void dot(double x, double y, double radius, Ink ink);
  void box(double left, double top, double right, double bottom, Ink ink);
  /// UTF-8; (left, top) is the corner of the first line.
  void text(double left, double top, double height, std::string_view words, Ink ink);
  /// Of the text at that height, px.
  static double text_width(double height, std::string_view words);

 private:
  template <typename Coverage>
  void cover(double left, double top, double right, double bottom, Ink ink, Coverage&& coverage);

  int width_, height_;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace onestroke
