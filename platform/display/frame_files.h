#pragma once

#include "display/film.h"
#include "display/offscreen.h"

#include <optional>

namespace onestroke {

/// The files that an off-screen display leaves: numbered pictures and a film.
class FrameFiles {
 public:
  /// Makes the directory and tries it. Throws Error.
  explicit FrameFiles(const OffscreenOptions& options);

  /// The next frame. Throws Error where it cannot be written.
  void add(std::span<const std::uint8_t> rgba);
  /// A frame that there is no picture of; those after it keep their numbers and their time.
  void leave_out();
  void finish();
  std::vector<std::string> report() const;

 private:
  OffscreenOptions options_;
  std::optional<Film> film_;
  int frames_ = 0, pictures_ = 0, filmed_ = 0, last_picture_ = 0;
};

}  // namespace onestroke
