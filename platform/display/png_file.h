#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace onestroke {

/// Writes RGBA rows from the top, without padding, as an 8-bit RGB PNG; alpha is dropped. Fast rather than small.
/// Throws Error where the file cannot be written in full.
void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgba);

}  // namespace onestroke
