#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace onestroke::golden {

/// 8-bit RGB, rows from the top, without padding.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;

  std::uint8_t* at(int x, int y) { return rgb.data() + 3 * (y * width + x); }
  const std::uint8_t* at(int x, int y) const { return rgb.data() + 3 * (y * width + x); }
};

Picture from_rgba(int width, int height, std::span<const std::uint8_t> rgba);

/// Throw Error where the file cannot be read or written.
Picture read_png(const std::filesystem::path& file);
void write_png(const std::filesystem::path& file, const Picture& picture);

/// What one test forgives: a pixel differs where a channel is off by more than `level`; `pixels` may differ.
struct Tolerance {
  int level = 1;
  int pixels = 0;
};

struct Comparison {
  bool same = false;
  int worst = 0;       ///< Largest difference of a channel.
  int differing = 0;   ///< Pixels beyond the level; all of them where the sizes differ.
  std::string words;   ///< What was found, one line.
  Picture difference;  ///< Grey where the pictures agree, red where they do not; empty where the sizes differ.
};

Comparison compare(const Picture& expected, const Picture& actual, Tolerance tolerance);

}  // namespace onestroke::golden
