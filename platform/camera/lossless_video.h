#pragma once

#include "camera/recording_format.h"

#include <filesystem>
#include <memory>

struct AVFrame;

namespace onestroke {

/// A Matroska file of pictures without loss, FFVHUFF: of what libav can write, it takes least of a processor, and a
/// half to two thirds of the pixels' bytes. Each picture is in the file when add() returns. One thread.
class LosslessVideo {
 public:
  /// For pictures of this size and format. Throws Error where the file cannot be made.
  LosslessVideo(const std::filesystem::path& file, const Picture& like);
  ~LosslessVideo();

  bool takes(const Picture& picture) const;
  /// Throws Error where the file cannot be written.
  VideoPlace add(const Picture& picture);
  /// Writes what players need to find places. Throws Error likewise.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The planes of a picture whose size and format are known, from its frame in such a video, into memory of
/// plane_bytes(). False where the frame is none of it.
bool unpack_frame(const AVFrame& frame, const Picture& picture, std::uint8_t* to);

}  // namespace onestroke
