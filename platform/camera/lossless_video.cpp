#include "camera/lossless_video.h"

#include "core/error.h"
#include "files/libav.h"

#include <algorithm>
#include <cstring>

namespace onestroke {
namespace {

AVPixelFormat pixels_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::rgb8:
      return AV_PIX_FMT_RGB24;
    case PixelFormat::gray8:
      return AV_PIX_FMT_GRAY8;
    case PixelFormat::nv12:
      return AV_PIX_FMT_YUV420P;
    case PixelFormat::yuyv:
      return AV_PIX_FMT_YUV422P;
  }
  return AV_PIX_FMT_NONE;
}

/// A row of every step-th byte of `from` from the first one on.
void gather(const std::uint8_t* from, std::size_t step, int count, std::uint8_t* to) {
  for (int i = 0; i < count; ++i, from += step) to[i] = *from;
}

void scatter(const std::uint8_t* from, int count, std::uint8_t* to, std::size_t step) {
  for (int i = 0; i < count; ++i, to += step) *to = from[i];
}

std::uint8_t* row_of(const AVFrame& frame, int plane, int y) {
  return frame.data[plane] + static_cast<std::ptrdiff_t>(y) * frame.linesize[plane];
}

const std::uint8_t* row_of(const Picture& p, std::size_t plane, int y) {
  return p.planes[plane] + static_cast<std::size_t>(y) * p.strides[plane];
}

/// Puts the chroma of nv12 and yuyv into planes of its own.
void pack_frame(const Picture& p, AVFrame& frame) {
  const bool yuyv = p.format == PixelFormat::yuyv;
  const auto bytes = static_cast<std::size_t>(p.format == PixelFormat::rgb8 ? 3 * p.width : p.width);
  for (int y = 0; y < p.height; ++y) {
    const std::uint8_t* row = row_of(p, 0, y);
    if (!yuyv) {
      std::memcpy(row_of(frame, 0, y), row, bytes);
      continue;
    }
    gather(row, 2, p.width, row_of(frame, 0, y));
    gather(row + 1, 4, p.width / 2, row_of(frame, 1, y));
    gather(row + 3, 4, p.width / 2, row_of(frame, 2, y));
  }
  if (p.format != PixelFormat::nv12) return;
  for (int y = 0; y < p.height / 2; ++y)
    for (const int plane : {1, 2}) gather(row_of(p, 1, y) + plane - 1, 2, p.width / 2, row_of(frame, plane, y));
}

/// Where red, green and blue are in a pixel of so many bytes.
struct RgbLayout {
  int pixels;
  std::size_t bytes;
  std::array<std::size_t, 3> at;
};
constexpr std::array rgb_layouts{RgbLayout{AV_PIX_FMT_RGB24, 3, {0, 1, 2}}, RgbLayout{AV_PIX_FMT_BGR24, 3, {2, 1, 0}},
                                 RgbLayout{AV_PIX_FMT_BGR0, 4, {2, 1, 0}},  RgbLayout{AV_PIX_FMT_BGRA, 4, {2, 1, 0}},
                                 RgbLayout{AV_PIX_FMT_RGB0, 4, {0, 1, 2}},  RgbLayout{AV_PIX_FMT_RGBA, 4, {0, 1, 2}}};

bool unpack_rgb(const AVFrame& frame, std::uint8_t* to) {
  const auto* const layout = std::ranges::find(rgb_layouts, frame.format, &RgbLayout::pixels);
  if (layout == rgb_layouts.end()) return false;
  for (int y = 0; y < frame.height; ++y) {
    const std::uint8_t* from = row_of(frame, 0, y);
    for (int x = 0; x < frame.width; ++x, from += layout->bytes, to += 3)
      for (std::size_t c = 0; c < 3; ++c) to[c] = from[layout->at[c]];
  }
  return true;
}

}  // namespace

struct LosslessVideo::Impl {
  std::string name;
  int width = 0, height = 0;
  PixelFormat pixels = PixelFormat::rgb8;
  HeldAv<AVFormatContext> format;
  HeldAv<AVCodecContext> codec;
  HeldAv<AVFrame> frame;
  HeldAv<AVPacket> packet;
  AVStream* stream = nullptr;
  std::uint64_t count = 0;
  std::int64_t first_ns = 0, last_ms = -1;

  template <typename Result>
  auto check(Result result) const {
    return check_written(result, name);
  }
  void open_codec();
  void open_file();
};

void LosslessVideo::Impl::open_codec() {
  const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_FFVHUFF);
  if (!encoder) throw Error("cannot write " + name + ": this libavcodec has no FFVHUFF");
  codec.reset(check(avcodec_alloc_context3(encoder)));
  codec->width = width;
  codec->height = height;
  codec->pix_fmt = pixels_of(pixels);
  codec->time_base = {1, 1000};
  codec->thread_count = 1;
  const bool yuv = pixels == PixelFormat::nv12 || pixels == PixelFormat::yuyv;
  codec->color_range = yuv ? AVCOL_RANGE_MPEG : AVCOL_RANGE_JPEG;
  codec->colorspace = yuv ? AVCOL_SPC_SMPTE170M : AVCOL_SPC_UNSPECIFIED;
  if (format->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  check(avcodec_open2(codec.get(), encoder, nullptr));
  frame.reset(check(av_frame_alloc()));
  frame->format = codec->pix_fmt;
  frame->width = width;
  frame->height = height;
  check(av_frame_get_buffer(frame.get(), 0));
  packet.reset(check(av_packet_alloc()));
}

void LosslessVideo::Impl::open_file() {
  stream = check(avformat_new_stream(format.get(), nullptr));
  stream->time_base = codec->time_base;
  check(avcodec_parameters_from_context(stream->codecpar, codec.get()));
  check(avio_open(&format->pb, name.c_str(), AVIO_FLAG_WRITE));
  check(avformat_write_header(format.get(), nullptr));
}

LosslessVideo::LosslessVideo(const std::filesystem::path& file, const Picture& like) : impl_(std::make_unique<Impl>()) {
  Impl& m = *impl_;
  m.name = file.string();
  m.width = like.width;
  m.height = like.height;
  m.pixels = like.format;
  m.first_ns = like.exposure.start.ns;
  AVFormatContext* format = nullptr;
  m.check(avformat_alloc_output_context2(&format, nullptr, "matroska", m.name.c_str()));
  m.format.reset(format);
  m.open_codec();
  m.open_file();
}

LosslessVideo::~LosslessVideo() = default;

bool LosslessVideo::takes(const Picture& p) const {
  return p.width == impl_->width && p.height == impl_->height && p.format == impl_->pixels;
}

VideoPlace LosslessVideo::add(const Picture& picture) {
  Impl& m = *impl_;
  m.check(av_frame_make_writable(m.frame.get()));
  pack_frame(picture, *m.frame);
  constexpr std::int64_t ms = 1'000'000;
  m.last_ms = std::max(m.last_ms + 1, (picture.exposure.start.ns - m.first_ns + ms / 2) / ms);
  m.frame->pts = m.last_ms;
  m.check(avcodec_send_frame(m.codec.get(), m.frame.get()));
  m.check(avcodec_receive_packet(m.codec.get(), m.packet.get()));
  av_packet_rescale_ts(m.packet.get(), m.codec->time_base, m.stream->time_base);
  m.packet->stream_index = m.stream->index;
  m.check(av_write_frame(m.format.get(), m.packet.get()));
  av_packet_unref(m.packet.get());
  // Ends the cluster, so that all of it is there to be read.
  m.check(av_write_frame(m.format.get(), nullptr));
  flush_written(*m.format, m.name);
  return {m.count++, m.last_ms};
}

void LosslessVideo::finish() {
  Impl& m = *impl_;
  m.check(av_write_trailer(m.format.get()));
  m.check(avio_closep(&m.format->pb));
}

bool unpack_frame(const AVFrame& frame, const Picture& p, std::uint8_t* to) {
  if (frame.width != p.width || frame.height != p.height) return false;
  if (p.format == PixelFormat::rgb8) return unpack_rgb(frame, to);
  if (frame.format != pixels_of(p.format)) return false;
  const std::size_t step = p.format == PixelFormat::yuyv ? 2 : 1;
  for (int y = 0; y < p.height; ++y) {
    std::uint8_t* row = to + static_cast<std::size_t>(y) * p.strides[0];
    scatter(row_of(frame, 0, y), p.width, row, step);
    if (step == 1) continue;
    scatter(row_of(frame, 1, y), p.width / 2, row + 1, 4);
    scatter(row_of(frame, 2, y), p.width / 2, row + 3, 4);
  }
  if (p.format != PixelFormat::nv12) return true;
  std::uint8_t* chroma = to + p.strides[0] * static_cast<std::size_t>(p.height);
  for (int y = 0; y < p.height / 2; ++y, chroma += p.strides[1])
    for (const int plane : {1, 2}) scatter(row_of(frame, plane, y), p.width / 2, chroma + plane - 1, 2);
  return true;
}

}  // namespace onestroke
