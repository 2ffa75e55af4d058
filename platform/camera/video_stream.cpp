#include "camera/video_stream.h"

#include "core/error.h"
#include "files/libav.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

extern "C" {
#include <libavutil/display.h>
}

namespace onestroke {
namespace {

constexpr AVRational nanoseconds{1, 1'000'000'000};
// Some containers only estimate how many pictures they hold.
constexpr std::size_t estimate_error = 2;

HeldAv<AVFormatContext> open_format(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw Error("video " + file.string() + " is not there; give a video file");
  // What is wrong is said in the program's own words.
  av_log_set_level(AV_LOG_FATAL);
  AVFormatContext* opened = nullptr;
  const bool open = avformat_open_input(&opened, file.c_str(), nullptr, nullptr) >= 0;
  HeldAv<AVFormatContext> format(opened);
  if (!open || avformat_find_stream_info(format.get(), nullptr) < 0)
    throw Error("video " + file.string() + " is cut short, damaged or no video; give one that FFmpeg can play");
  return format;
}

const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
  const AVCodecParameters& p = *stream.codecpar;
  const AVPacketSideData* side =
      av_packet_side_data_get(p.coded_side_data, p.nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return side ? reinterpret_cast<const std::int32_t*>(side->data) : nullptr;
#else
  return reinterpret_cast<const std::int32_t*>(av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
#endif
}

std::int64_t time_of(const AVPacket& packet) {
  return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

}  // namespace

struct VideoStream::Impl {
  std::filesystem::path file;
  int threads = 0;
  HeldAv<AVFormatContext> format;
  HeldAv<AVCodecContext> codec;
  HeldAv<AVFrame> frame{av_frame_alloc()};
  HeldAv<AVPacket> packet{av_packet_alloc()};
  AVStream* stream = nullptr;
  double rate = 0;

  std::int64_t first = AV_NOPTS_VALUE;  // of the first picture, time base
  std::int64_t at = 0;                  // of the last one
  std::uint64_t number = 0;
  bool any = false, draining = false, kept = false, ended = false;
  std::vector<std::int64_t> times;  // of all pictures, sorted; empty before they are wanted

  void open();
  bool decode();
  bool send();
  void find_times();
  bool seek_to(std::int64_t target, std::int64_t before);
  bool find_key(std::int64_t target);
  bool play_to(std::int64_t target);
  std::int64_t time_of_frame() const;
  void note_time();
  std::int64_t first_or_0() const { return first == AV_NOPTS_VALUE ? 0 : first; }
  std::uint64_t number_at(std::int64_t when) const {
    return static_cast<std::uint64_t>(std::ranges::lower_bound(times, when) - times.begin());
  }
  std::int64_t ticks(double seconds) const { return std::llround(seconds / av_q2d(stream->time_base)); }
};

void VideoStream::Impl::open() {
  codec.reset();
  format = open_format(file);
  const AVCodec* decoder = nullptr;
  const int index = av_find_best_stream(format.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
  if (index < 0 || !decoder)
    throw Error("video " + file.string() + " holds no picture that can be decoded; give another");
  stream = format->streams[index];
  for (unsigned i = 0; i < format->nb_streams; ++i)
    if (format->streams[i] != stream) format->streams[i]->discard = AVDISCARD_ALL;
  codec.reset(avcodec_alloc_context3(decoder));
  codec->thread_count = threads;
  codec->pkt_timebase = stream->time_base;
  if (avcodec_parameters_to_context(codec.get(), stream->codecpar) < 0 ||
      avcodec_open2(codec.get(), decoder, nullptr) < 0)
    throw Error("video " + file.string() + " cannot be decoded; give one that FFmpeg can play");
  rate = std::max(0.0, av_q2d(av_guess_frame_rate(format.get(), stream, nullptr)));
  if (!std::isfinite(rate)) rate = 0;
  any = draining = kept = ended = false;
  number = 0;
}

/// Feeds the decoder; false where there is nothing more to feed.
bool VideoStream::Impl::send() {
  while (!draining) {
    const int read = av_read_frame(format.get(), packet.get());
    if (read == AVERROR(EAGAIN)) continue;
    draining = read < 0;
    if (!draining && packet->stream_index != stream->index) {
      av_packet_unref(packet.get());
      continue;
    }
    const int sent = avcodec_send_packet(codec.get(), draining ? nullptr : packet.get());
    av_packet_unref(packet.get());
    if (sent >= 0 || draining) return true;
  }
  return false;
}

/// The decoder's next picture into `frame`.
bool VideoStream::Impl::decode() {
  for (;;) {
    const int got = avcodec_receive_frame(codec.get(), frame.get());
    if (got >= 0) return true;
    if (got == AVERROR_EOF || (got == AVERROR(EAGAIN) && !send())) return false;
  }
}

std::int64_t VideoStream::Impl::time_of_frame() const {
  if (frame->best_effort_timestamp != AV_NOPTS_VALUE) return frame->best_effort_timestamp;
  return any ? at + (rate > 0 ? ticks(1 / rate) : 1) : first_or_0();
}

void VideoStream::Impl::note_time() {
  const std::int64_t when = time_of_frame();
  if (first == AV_NOPTS_VALUE) first = when;
  number = any ? number + 1 : times.empty() ? 0 : number_at(when);
  at = when;
  any = true;
}

/// Goes through the packets alone; nothing is decoded.
void VideoStream::Impl::find_times() {
  if (!times.empty()) return;
  const HeldAv<AVFormatContext> other = open_format(file);
  for (unsigned i = 0; i < other->nb_streams; ++i)
    if (static_cast<int>(i) != stream->index) other->streams[i]->discard = AVDISCARD_ALL;
  while (av_read_frame(other.get(), packet.get()) >= 0) {
    const std::int64_t when = time_of(*packet);
    const bool counts = packet->stream_index == stream->index && (packet->flags & AV_PKT_FLAG_DISCARD) == 0 &&
                        when != AV_NOPTS_VALUE && (first == AV_NOPTS_VALUE || when >= first);
    if (counts) times.push_back(when);
    av_packet_unref(packet.get());
  }
  std::ranges::sort(times);
  if (first == AV_NOPTS_VALUE && !times.empty()) first = times.front();
}

/// Leaves in `frame` the first picture that can be decoded without those before it; false where that is later than
/// `target`.
bool VideoStream::Impl::find_key(std::int64_t target) {
  while (decode())
    if (is_key(*frame)) return frame->best_effort_timestamp != AV_NOPTS_VALUE && frame->best_effort_timestamp <= target;
  return false;
}

/// From the start, where a file cannot be entered in its middle.
bool VideoStream::Impl::play_to(std::int64_t target) {
  open();
  while (decode()) {
    if (times.empty() ? time_of_frame() - first_or_0() >= target : frame->best_effort_timestamp >= target) {
      kept = true;
      return true;
    }
    if (times.empty()) note_time();
  }
  ended = true;
  return false;
}

/// Leaves the picture of `target` in `frame`, decoding on from a place that is `before` ticks earlier.
bool VideoStream::Impl::seek_to(std::int64_t target, std::int64_t before) {
  if (av_seek_frame(format.get(), stream->index, target - before, AVSEEK_FLAG_BACKWARD) < 0) return false;
  avcodec_flush_buffers(codec.get());
  draining = false;
  if (!find_key(target)) return false;
  while (frame->best_effort_timestamp == AV_NOPTS_VALUE || frame->best_effort_timestamp < target)
    if (!decode()) return false;
  return true;
}

VideoStream::VideoStream(const std::filesystem::path& file, int threads) : impl_(std::make_unique<Impl>()) {
  impl_->file = file;
  impl_->threads = threads;
  impl_->open();
}

VideoStream::~VideoStream() = default;

const AVFrame* VideoStream::next() {
  Impl& m = *impl_;
  if (m.ended || (!m.kept && !m.decode())) {
    m.ended = true;
    return nullptr;
  }
  m.kept = false;
  m.note_time();
  return m.frame.get();
}

std::uint64_t VideoStream::number() const {
  return impl_->number;
}

bool VideoStream::started() const {
  return impl_->any;
}

Duration VideoStream::time() const {
  return {av_rescale_q(impl_->at - impl_->first, impl_->stream->time_base, nanoseconds)};
}

bool VideoStream::go_to(Duration time) {
  Impl& m = *impl_;
  m.find_times();
  m.ended = m.kept = m.any = false;
  const auto wanted = std::ranges::find_if(m.times, [&](std::int64_t when) {
    return av_rescale_q(when - m.first, m.stream->time_base, nanoseconds) >= time.ns;
  });
  if (wanted == m.times.end() && !m.times.empty()) {
    m.ended = m.any = true;
    m.number = m.times.size() - 1;
    m.at = m.times.back();
    return false;
  }
  // Containers find the place by other times than those of the pictures, and a little early is right, too.
  if (!m.times.empty() && *wanted > m.first)
    for (const double earlier : {0.0, 1.0, 4.0, 16.0})
      if ((m.kept = m.seek_to(*wanted, m.ticks(earlier)))) return true;
  return m.play_to(m.times.empty() ? m.ticks(time.seconds()) : *wanted);
}

double VideoStream::rate() const {
  return impl_->rate;
}

std::size_t VideoStream::length() const {
  const Impl& m = *impl_;
  if (m.stream->nb_frames > 0) return static_cast<std::size_t>(m.stream->nb_frames);
  const double seconds = m.stream->duration > 0 ? static_cast<double>(m.stream->duration) * av_q2d(m.stream->time_base)
                         : m.format->duration > 0 ? static_cast<double>(m.format->duration) / AV_TIME_BASE
                                                  : 0;
  return static_cast<std::size_t>(std::max(0.0, std::floor(seconds * m.rate + 0.5)));
}

bool VideoStream::cut_short() const {
  const Impl& m = *impl_;
  const std::uint64_t seen = m.any ? m.number + 1 : 0;
  if (m.stream->nb_frames > 0) return seen + estimate_error < static_cast<std::uint64_t>(m.stream->nb_frames);
  // Of pictures that come at all times only the time can be expected; sound may go on for longer.
  if (m.format->nb_streams > 1 || m.format->duration <= 0 || m.rate <= 0 || !m.any) return false;
  const double missing = static_cast<double>(m.format->duration) / AV_TIME_BASE - time().seconds();
  return missing > static_cast<double>(estimate_error + 1) / m.rate + 0.5;
}

int VideoStream::turn() const {
  const std::int32_t* matrix = display_matrix(*impl_->stream);
  if (!matrix) return 0;
  const double turned = -av_display_rotation_get(matrix);
  const double quarter = std::round(turned / 90);
  const double determinant = static_cast<double>(matrix[0]) * matrix[4] - static_cast<double>(matrix[1]) * matrix[3];
  if (std::isnan(turned) || std::abs(turned - 90 * quarter) > 0.1 || determinant < 0) return -1;
  return 90 * ((static_cast<int>(quarter) % 4 + 4) % 4);
}

}  // namespace onestroke
