#pragma once

#include "core/time.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

struct AVFrame;

namespace onestroke {

/// The first video of a file, picture by picture, decoded by libav on threads of its own. One thread at a time.
class VideoStream {
 public:
  /// threads: of the decoder; 0 for as many as there are processors. Throws Error, which names the file, where it holds
  /// no video that can be decoded.
  explicit VideoStream(const std::filesystem::path& file, int threads = 0);
  ~VideoStream();

  /// The next picture, valid until the next call; nullptr at the end. What cannot be decoded is left out.
  const AVFrame* next();
  /// Of the last picture: its number from the first one on, and its own time after that one's, to the nanosecond as far
  /// as the file says it.
  std::uint64_t number() const;
  bool started() const;  ///< next() gave a picture since the file was opened or a place was gone to.
  Duration time() const;
  /// next() goes on with the first picture that is no earlier than this. False where there is none. The first call
  /// looks through the file for the times of all its pictures.
  bool go_to(Duration time);

  /// Pictures a second, 0 where that is not known, and how many pictures there are, where the file does not say by an
  /// estimate.
  double rate() const;
  std::size_t length() const;
  /// True where the file has more to show, by what it says of itself, than next() gave until its end.
  bool cut_short() const;
  /// By how many degrees the pictures are to be turned to stand upright, clockwise: 0, 90, 180 or 270; -1 where they
  /// are to be mirrored, or turned by another angle.
  int turn() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke
