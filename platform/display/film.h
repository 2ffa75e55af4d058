#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace onestroke {

/// An MP4 film, H.264 in yuv420p at constant quality, which any player shows. Odd sizes lose their last row or column.
class Film {
 public:
  /// `rate` is in frames per second. Throws Error where the file cannot be made.
  Film(const std::filesystem::path& file, int width, int height, double rate);
  ~Film();

  /// RGBA rows from the top, without padding. Throws Error where the file cannot be written.
  void add(std::span<const std::uint8_t> rgba);
  /// A frame that there is no picture of: the one before is seen for longer.
  void leave_out();
  /// Writes what is left; the film plays only after this. Throws Error likewise.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke
