#include "camera/picture_bytes.h"

#include <cstddef>

namespace onestroke {

bool jpeg_is_complete(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t end_mark = 0xD9, scan_mark = 0xDA;
  std::size_t i = 2;
  bool in_scan = false;
  while (i + 1 < bytes.size()) {
    if (bytes[i] != 0xFF) {
      if (!in_scan) return false;
      ++i;
      continue;
    }
    const std::uint8_t mark = bytes[i + 1];
    const bool restart = mark >= 0xD0 && mark <= 0xD7;
    if (mark == end_mark) return true;
    if (mark == 0xFF) {
      ++i;
    } else if (mark == 0x00 || mark == 0x01 || restart) {
      i += 2;
    } else {
      if (i + 3 >= bytes.size()) return false;
      in_scan = mark == scan_mark;
      i += 2 + (static_cast<std::size_t>(bytes[i + 2]) << 8 | bytes[i + 3]);
    }
  }
  return false;
}

void swap_to_rgb(const std::uint8_t* bgr, std::size_t bgr_stride, int width, int height, std::uint8_t* rgb) {
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = bgr + static_cast<std::size_t>(y) * bgr_stride;
    for (int x = 0; x < width; ++x, from += 3, rgb += 3) {
      rgb[0] = from[2];
      rgb[1] = from[1];
      rgb[2] = from[0];
    }
  }
}

}  // namespace onestroke
