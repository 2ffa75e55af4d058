#pragma once

#include "files/libav.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/opt.h>
}

namespace onestroke::test {

/// How a test's video is written.
struct VideoKind {
  const char* codec = "mpeg4";
  AVPixelFormat pixels = AV_PIX_FMT_YUV420P;
  int width = 64, height = 48;
  int key_every = 12;
  int between = 0;  ///< Pictures that need a later one.
  AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
  AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
  double turned = 0;       ///< Degrees, clockwise, that a player is to turn it by.
  std::int64_t lasts = 1;  ///< A picture, in units of the time base.
  AVRational time_base{1, 1000};
};

/// Fills a frame's planes for the picture of that number.
using Paint = void (*)(AVFrame& frame, int number);

/// Every byte of every plane is the level of the number, so that each picture can be told from the next.
inline int level_of(int number) {
  return 30 + 4 * (number % 48);
}

inline void paint_level(AVFrame& frame, int number) {
  for (int p = 0; p < 3 && frame.data[p]; ++p) {
    const int rows = p == 0 ? frame.height : frame.height / 2;
    for (int y = 0; y < rows; ++y)
      std::fill_n(frame.data[p] + y * frame.linesize[p], frame.linesize[p],
                  static_cast<std::uint8_t>(p == 0 ? level_of(number) : 128));
  }
}

/// Writes pictures at these times, in units of the kind's time base.
inline void write_video(const std::filesystem::path& file, const VideoKind& kind, std::span<const std::int64_t> times,
                        Paint paint = paint_level) {
  const std::string name = file.string();
  AVFormatContext* made = nullptr;
  check_written(avformat_alloc_output_context2(&made, nullptr, nullptr, name.c_str()), name);
  const HeldAv<AVFormatContext> format(made);
  const AVCodec* encoder = avcodec_find_encoder_by_name(kind.codec);
  const HeldAv<AVCodecContext> codec(check_written(avcodec_alloc_context3(encoder), name));
  codec->width = kind.width;
  codec->height = kind.height;
  codec->pix_fmt = kind.pixels;
  codec->time_base = kind.time_base;
  codec->gop_size = kind.key_every;
  codec->max_b_frames = kind.between;
  codec->color_range = kind.range;
  codec->colorspace = kind.matrix;
  codec->flags |= AV_CODEC_FLAG_QSCALE | AV_CODEC_FLAG_GLOBAL_HEADER;
  codec->global_quality = 2 * FF_QP2LAMBDA;
  codec->strict_std_compliance = FF_COMPLIANCE_UNOFFICIAL;
  codec->log_level_offset = AV_LOG_INFO - AV_LOG_ERROR;
  if (std::string(kind.codec) == "libx264") av_opt_set(codec->priv_data, "crf", "10", 0);
  check_written(avcodec_open2(codec.get(), encoder, nullptr), name);
  AVStream* stream = check_written(avformat_new_stream(format.get(), nullptr), name);
  stream->time_base = kind.time_base;
  check_written(avcodec_parameters_from_context(stream->codecpar, codec.get()), name);
  if (kind.turned != 0) {
    std::array<std::int32_t, 9> matrix{};
    av_display_rotation_set(matrix.data(), kind.turned);
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
    AVCodecParameters& p = *stream->codecpar;
    AVPacketSideData* side =
        av_packet_side_data_new(&p.coded_side_data, &p.nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX, sizeof matrix, 0);
    std::memcpy(side->data, matrix.data(), sizeof matrix);
#else
    std::memcpy(av_stream_new_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, sizeof matrix), matrix.data(),
                sizeof matrix);
#endif
  }
  check_written(avio_open(&format->pb, name.c_str(), AVIO_FLAG_WRITE), name);
  check_written(avformat_write_header(format.get(), nullptr), name);
  const HeldAv<AVFrame> frame(av_frame_alloc());
  frame->format = kind.pixels;
  frame->width = kind.width;
  frame->height = kind.height;
  frame->color_range = kind.range;
  frame->colorspace = kind.matrix;
  check_written(av_frame_get_buffer(frame.get(), 0), name);
  const HeldAv<AVPacket> packet(av_packet_alloc());
  const auto drain = [&] {
    while (avcodec_receive_packet(codec.get(), packet.get()) >= 0) {
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      packet->duration = av_rescale_q(kind.lasts, kind.time_base, stream->time_base);
      packet->stream_index = stream->index;
      check_written(av_interleaved_write_frame(format.get(), packet.get()), name);
    }
  };
  for (std::size_t i = 0; i < times.size(); ++i) {
    check_written(av_frame_make_writable(frame.get()), name);
    paint(*frame, static_cast<int>(i));
    frame->pts = times[i];
    check_written(avcodec_send_frame(codec.get(), frame.get()), name);
    drain();
  }
  avcodec_send_frame(codec.get(), nullptr);
  drain();
  check_written(av_write_trailer(format.get()), name);
}

}  // namespace onestroke::test
