#pragma once

#include "core/picture.h"

#include <cstddef>
#include <cstdint>

namespace onestroke {

/// The bytes of a plane without padding.
struct PlaneShape {
  std::size_t row_bytes = 0, rows = 0;  ///< 0 where the format has no such plane.

  std::size_t bytes() const { return row_bytes * rows; }
};

/// Plane 0 or 1. Where pixels share their colour, a last one that has none to share with counts as two.
PlaneShape plane_shape(PixelFormat format, int width, int height, std::size_t plane);

/// The bytes of a picture's planes without padding, which copy_planes() copies, one plane after the other.
std::size_t plane_bytes(PixelFormat format, int width, int height);
void copy_planes(const Picture& picture, std::uint8_t* to);
/// The planes and strides of a picture, whose size and format are known, of bytes so copied.
void set_planes(Picture& picture, const std::uint8_t* bytes);

}  // namespace onestroke
