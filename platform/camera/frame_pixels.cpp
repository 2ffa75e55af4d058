#include "camera/frame_pixels.h"

#include "core/picture_planes.h"
#include "files/libav.h"

#include <algorithm>
#include <array>
#include <cstring>

extern "C" {
#include <libavutil/imgutils.h>
}

namespace onestroke {
namespace {

// swscale writes whole vectors, past the end of a row.
constexpr std::size_t overhang = 64;

/// YUVJ formats are the plain ones in full range, by another name.
AVPixelFormat plain(int format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    case AV_PIX_FMT_YUVJ440P:
      return AV_PIX_FMT_YUV440P;
    case AV_PIX_FMT_YUVJ411P:
      return AV_PIX_FMT_YUV411P;
    default:
      return static_cast<AVPixelFormat>(format);
  }
}

bool full_range(const AVFrame& frame) {
  return frame.color_range == AVCOL_RANGE_JPEG || plain(frame.format) != frame.format;
}

bool usual_matrix(const AVFrame& frame) {
  return frame.colorspace == AVCOL_SPC_UNSPECIFIED || frame.colorspace == AVCOL_SPC_BT470BG ||
         frame.colorspace == AVCOL_SPC_SMPTE170M;
}

PixelFormat format_for(const AVFrame& frame) {
  const bool usual = usual_matrix(frame) && !full_range(frame) && frame.width % 2 == 0 && frame.height % 2 == 0;
  if (frame.format == AV_PIX_FMT_NV12 && usual) return PixelFormat::nv12;
  if (frame.format == AV_PIX_FMT_YUYV422 && usual) return PixelFormat::yuyv;
  if (frame.format == AV_PIX_FMT_GRAY8 && frame.color_range != AVCOL_RANGE_MPEG) return PixelFormat::gray8;
  return PixelFormat::rgb8;
}

void copy_rows(const std::uint8_t* from, std::ptrdiff_t step, std::size_t row, int rows, std::uint8_t* to) {
  for (int y = 0; y < rows; ++y, from += step, to += row) std::memcpy(to, from, row);
}

/// rgb8 without padding, turned clockwise.
void turn_rgb(const std::uint8_t* from, int width, int height, int degrees, std::uint8_t* to) {
  const std::ptrdiff_t across = degrees == 180 ? -3 : degrees == 90 ? 3 * height : -3 * height;
  const std::ptrdiff_t down = degrees == 180 ? -3 * width : degrees == 90 ? -3 : 3;
  const std::ptrdiff_t first = degrees == 180  ? 3 * (static_cast<std::ptrdiff_t>(width) * height - 1)
                               : degrees == 90 ? 3 * (height - 1)
                                               : 3 * static_cast<std::ptrdiff_t>(height) * (width - 1);
  for (int y = 0; y < height; ++y) {
    std::uint8_t* at = to + first + y * down;
    for (int x = 0; x < width; ++x, from += 3, at += across) std::copy_n(from, 3, at);
  }
}

}  // namespace

FramePixels::FramePixels(const AVFrame& first, int turn)
    : width_(first.width),
      height_(first.height),
      turn_(turn),
      pixels_(first.format),
      format_(turn == 0 ? format_for(first) : PixelFormat::rgb8) {
  if (turn != 0) upright_.resize(bytes());
}

FramePixels::~FramePixels() {
  sws_freeContext(scaler_);
}

std::size_t FramePixels::bytes() const {
  return 3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + overhang;
}

bool FramePixels::fill(const AVFrame& frame, std::uint8_t* buffer, Picture& picture) {
  if (frame.width != width_ || frame.height != height_) return false;
  if (format_ != PixelFormat::rgb8 && (frame.format != pixels_ || format_for(frame) != format_)) return false;
  picture.width = width();
  picture.height = height();
  picture.format = format_;
  set_planes(picture, buffer);
  if (format_ == PixelFormat::rgb8) {
    if (turn_ == 0) return convert(frame, buffer);
    if (!convert(frame, upright_.data())) return false;
    turn_rgb(upright_.data(), width_, height_, turn_, buffer);
    return true;
  }
  copy_rows(frame.data[0], frame.linesize[0], picture.strides[0], height_, buffer);
  if (format_ == PixelFormat::nv12)
    copy_rows(frame.data[1], frame.linesize[1], picture.strides[1], height_ / 2,
              buffer + picture.strides[0] * static_cast<std::size_t>(height_));
  return true;
}

bool FramePixels::convert(const AVFrame& frame, std::uint8_t* rgb) {
  const int stride = 3 * width_;
  if (frame.format == AV_PIX_FMT_RGB24) {
    copy_rows(frame.data[0], frame.linesize[0], static_cast<std::size_t>(stride), height_, rgb);
    return true;
  }
  scaler_ = sws_getCachedContext(scaler_, width_, height_, plain(frame.format), width_, height_, AV_PIX_FMT_RGB24,
                                 SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT, nullptr, nullptr, nullptr);
  if (!scaler_) return false;
  const int* matrix = sws_getCoefficients(frame.colorspace);
  sws_setColorspaceDetails(scaler_, matrix, full_range(frame), sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16,
                           1 << 16);
  const std::array<std::uint8_t*, 1> to{rgb};
  return sws_scale(scaler_, frame.data, frame.linesize, 0, height_, to.data(), &stride) == height_;
}

}  // namespace onestroke
