#pragma once

#include "core/picture.h"

#include <cstdint>
#include <memory>
#include <vector>

struct AVFrame;
struct SwsContext;

namespace onestroke {

/// Brings decoded pictures into a picture's planes. Planes that a picture can have as they are (nv12 and yuyv of BT.601
/// in limited range, rgb8, gray8 in full range) are copied; all others become rgb8, by the matrix and the range that
/// the video says it has, BT.601 in limited range where it says none.
class FramePixels {
 public:
  /// For frames like this one, to be turned clockwise by 0, 90, 180 or 270 degrees.
  explicit FramePixels(const AVFrame& first, int turn = 0);
  ~FramePixels();

  int width() const { return turn_ % 180 == 0 ? width_ : height_; }
  int height() const { return turn_ % 180 == 0 ? height_ : width_; }
  /// Of the buffers that fill() takes.
  std::size_t bytes() const;
  /// Fills size, format, planes and strides. False where the frame has another size than the first one, or cannot be
  /// brought into its format.
  bool fill(const AVFrame& frame, std::uint8_t* buffer, Picture& picture);

 private:
  bool convert(const AVFrame& frame, std::uint8_t* rgb);

  int width_, height_, turn_;
  int pixels_;  // libav's pixel format of the first frame
  PixelFormat format_;
  SwsContext* scaler_ = nullptr;
  std::vector<std::uint8_t> upright_;  // what is yet to be turned
};

}  // namespace onestroke
