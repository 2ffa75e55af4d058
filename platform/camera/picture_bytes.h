#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace onestroke {

/// True where a JPEG stream reaches its end mark.
bool jpeg_is_complete(std::span<const std::uint8_t> bytes);

/// Copies rows of blue, green, red to red, green, blue.
void swap_to_rgb(const std::uint8_t* bgr, std::size_t bgr_stride, int width, int height, std::uint8_t* rgb);

}  // namespace onestroke
