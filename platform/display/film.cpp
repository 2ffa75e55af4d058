#include "display/film.h"

#include "core/error.h"
#include "files/libav.h"

#include <string>

extern "C" {
#include <libavutil/opt.h>
}

namespace onestroke {

struct Film::Impl {
  std::string name;
  int width = 0, height = 0;  // of the pictures given, which may be odd
  HeldAv<AVFormatContext> format;
  HeldAv<AVCodecContext> codec;
  HeldAv<AVFrame> frame;
  HeldAv<AVPacket> packet;
  HeldAv<SwsContext> scaler;
  AVStream* stream = nullptr;
  bool finished = false;

  template <typename Result>
  auto check(Result result) const {
    return check_written(result, name);
  }

  void open_codec(double rate);
  void open_file();
  void drain();
};

void Film::Impl::open_codec(double rate) {
  const AVCodec* encoder = avcodec_find_encoder_by_name("libx264");
  if (!encoder) throw Error("cannot write " + name + ": this libavcodec has no libx264; switch the film off");
  codec.reset(check(avcodec_alloc_context3(encoder)));
  // Errors still reach standard error; the encoder's report of every film would drown the program's own words.
  codec->log_level_offset = AV_LOG_INFO - AV_LOG_ERROR;
  codec->width = width & ~1;
  codec->height = height & ~1;
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->framerate = av_d2q(rate, 100000);
  codec->time_base = av_inv_q(codec->framerate);
  codec->gop_size = static_cast<int>(rate * 2) + 1;
  codec->color_range = AVCOL_RANGE_MPEG;
  codec->colorspace = AVCOL_SPC_BT709;
  codec->color_primaries = AVCOL_PRI_BT709;
  codec->color_trc = AVCOL_TRC_BT709;
  if (format->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  check(av_opt_set(codec->priv_data, "crf", "17", 0));
  check(av_opt_set(codec->priv_data, "preset", "veryfast", 0));
  check(avcodec_open2(codec.get(), encoder, nullptr));

  frame.reset(check(av_frame_alloc()));
  frame->format = codec->pix_fmt;
  frame->width = codec->width;
  frame->height = codec->height;
  check(av_frame_get_buffer(frame.get(), 0));
  packet.reset(check(av_packet_alloc()));
  scaler.reset(check(sws_getContext(codec->width, codec->height, AV_PIX_FMT_RGBA, codec->width, codec->height,
                                    codec->pix_fmt, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr)));
  const int* coefficients = sws_getCoefficients(SWS_CS_ITU709);
  sws_setColorspaceDetails(scaler.get(), coefficients, 1, coefficients, 0, 0, 1 << 16, 1 << 16);
}

void Film::Impl::open_file() {
  stream = check(avformat_new_stream(format.get(), nullptr));
  stream->time_base = codec->time_base;
  stream->avg_frame_rate = codec->framerate;
  check(avcodec_parameters_from_context(stream->codecpar, codec.get()));
  check(avio_open(&format->pb, name.c_str(), AVIO_FLAG_WRITE));
  check(avformat_write_header(format.get(), nullptr));
}

void Film::Impl::drain() {
  for (;;) {
    const int result = avcodec_receive_packet(codec.get(), packet.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    check(result);
    packet->duration = 1;
    av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
    packet->stream_index = stream->index;
    check(av_interleaved_write_frame(format.get(), packet.get()));
    flush_written(*format, name);
  }
}

Film::Film(const std::filesystem::path& file, int width, int height, double rate) : impl_(std::make_unique<Impl>()) {
  impl_->name = file.string();
  impl_->width = width;
  impl_->height = height;
  AVFormatContext* format = nullptr;
  impl_->check(avformat_alloc_output_context2(&format, nullptr, "mp4", impl_->name.c_str()));
  impl_->format.reset(format);
  impl_->open_codec(rate);
  impl_->open_file();
  impl_->frame->pts = 0;
}

Film::~Film() = default;

void Film::add(std::span<const std::uint8_t> rgba) {
  Impl& m = *impl_;
  m.check(av_frame_make_writable(m.frame.get()));
  const std::uint8_t* from[] = {rgba.data()};
  const int stride[] = {4 * m.width};
  m.check(sws_scale(m.scaler.get(), from, stride, 0, m.codec->height, m.frame->data, m.frame->linesize));
  m.check(avcodec_send_frame(m.codec.get(), m.frame.get()));
  ++m.frame->pts;
  m.drain();
}

void Film::leave_out() {
  ++impl_->frame->pts;
}

void Film::finish() {
  Impl& m = *impl_;
  if (m.finished) return;
  m.finished = true;
  m.check(avcodec_send_frame(m.codec.get(), nullptr));
  m.drain();
  m.check(av_write_trailer(m.format.get()));
  m.check(avio_closep(&m.format->pb));
}

}  // namespace onestroke
