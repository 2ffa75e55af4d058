#pragma once

#include <cstddef>
#include <cstdio>  // for jpeglib.h, which needs it and does not say so
#include <memory>

struct jpeg_decompress_struct;

namespace onestroke {

/// What libjpeg allocates for one picture, taken from one block that is kept for the next picture. A picture that needs
/// more than the block has takes the rest from libjpeg itself, and the next block is larger.
class JpegMemory {
 public:
  JpegMemory();
  ~JpegMemory();
  JpegMemory(const JpegMemory&) = delete;
  JpegMemory& operator=(const JpegMemory&) = delete;

  /// Puts itself between the decoder, which has just been made, and libjpeg's own memory manager. Outlives it.
  void attach(jpeg_decompress_struct& decoder);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke
