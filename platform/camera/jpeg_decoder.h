#pragma once

#include "camera/live_options.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace onestroke {

/// Baseline and progressive JPEG to rgb8, by libjpeg-turbo. Allocates nothing for a picture no larger than those
/// before. One thread.
class JpegDecoder {
 public:
  enum class Result {
    ok,
    cut,         ///< It ends before its end mark.
    damaged,     ///< It cannot be decoded as a whole.
    other_size,  ///< Of another size than was asked for.
  };

  JpegDecoder();
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /// Decodes into rows of `stride` bytes; `rgb` has size.height of them. Whatever is not ok leaves it undefined. Bytes
  /// behind the end mark, which cameras send, are none of the picture. Tables that cameras leave out are the usual
  /// ones.
  Result decode(std::span<const std::uint8_t> jpeg, PictureSize size, std::uint8_t* rgb, std::size_t stride) noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke
