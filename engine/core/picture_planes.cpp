#include "core/picture_planes.h"

#include <cstring>

namespace onestroke {

PlaneShape plane_shape(PixelFormat format, int width, int height, std::size_t plane) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  const std::size_t even = (w + 1) / 2 * 2;
  if (plane == 1) return format == PixelFormat::nv12 ? PlaneShape{even, (h + 1) / 2} : PlaneShape{};
  switch (format) {
    case PixelFormat::rgb8:
      return {3 * w, h};
    case PixelFormat::gray8:
    case PixelFormat::nv12:
      return {w, h};
    case PixelFormat::yuyv:
      return {2 * even, h};
  }
  return {};
}

std::size_t plane_bytes(PixelFormat format, int width, int height) {
  return plane_shape(format, width, height, 0).bytes() + plane_shape(format, width, height, 1).bytes();
}

void set_planes(Picture& p, const std::uint8_t* bytes) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < p.planes.size(); ++i) {
    const PlaneShape shape = plane_shape(p.format, p.width, p.height, i);
    p.planes[i] = shape.rows > 0 ? bytes + at : nullptr;
    p.strides[i] = shape.row_bytes;
    at += shape.bytes();
  }
}

void copy_planes(const Picture& from, std::uint8_t* to) {
  for (std::size_t i = 0; i < from.planes.size(); ++i) {
    const PlaneShape shape = plane_shape(from.format, from.width, from.height, i);
    for (std::size_t y = 0; y < shape.rows; ++y, to += shape.row_bytes)
      std::memcpy(to, from.planes[i] + y * from.strides[i], shape.row_bytes);
  }
}

}  // namespace onestroke
