#include "payload_stream.h"

#include "uvc_descriptors.h"

#include <linux/usb/video.h>

#include <algorithm>

namespace onestroke::usb {
namespace {

constexpr std::size_t header_bytes = 12;

u32 ticks(Time time) {
  constexpr std::int64_t ticks_a_us = clock_hz / 1'000'000;
  return static_cast<u32>(time.ns * ticks_a_us / 1000);
}

/// USB's own count of ms, 11 bits.
u16 frame_number(Time time) {
  return static_cast<u16>(time.ns / 1'000'000 & 0x7ff);
}

}  // namespace

PayloadStream::PayloadStream(const VideoMode& mode, Duration interval, const CameraScript& script, EventLog& log)
    : mode_(mode), interval_(interval), script_(script), log_(log), due_(Time::now() + interval) {}

std::optional<Time> PayloadStream::next_at() const {
  if (over_) return std::nullopt;
  return sending_ ? Time{} : due_;
}

void PayloadStream::resume() {
  due_ = Time::now() + interval_;
}

void PayloadStream::begin(Time now) {
  if (!script_.loop && number_ >= mode_.pictures.size()) {
    over_ = true;
    log_.add("over");
    return;
  }
  const PlayedPicture& picture = mode_.pictures[number_ % mode_.pictures.size()];
  const bool cut = script_.cut_every && (number_ + 1) % *script_.cut_every == 0;
  if (now >= due_ + interval_) {
    log_.add("late", {{"number", number_}, {"by_ns", (now - due_).ns}});
    due_ = now;
  }
  size_ = cut ? picture.bytes.size() / 2 : picture.bytes.size();
  at_ = 0;
  sending_ = true;
  began_ticks_ = ticks(now);
  log_.add("frame", now, {{"number", number_}, {"picture", picture.name}, {"bytes", size_}, {"cut", cut}});
}

const Bytes& PayloadStream::take(std::size_t most) {
  payload_.clear();
  const Time now = Time::now();
  if (!sending_ && !over_ && now >= due_) begin(now);
  if (!sending_ || most <= header_bytes) return payload_;

  const std::size_t piece = std::min(most - header_bytes, size_ - at_);
  const bool last = at_ + piece == size_;
  append(payload_, static_cast<u8>(header_bytes),
         static_cast<u8>(UVC_STREAM_EOH | UVC_STREAM_PTS | UVC_STREAM_SCR | (odd_ ? UVC_STREAM_FID : 0) |
                         (last ? UVC_STREAM_EOF : 0)),
         began_ticks_, ticks(now), frame_number(now));
  const u8* const bytes = mode_.pictures[number_ % mode_.pictures.size()].bytes.data() + at_;
  payload_.insert(payload_.end(), bytes, bytes + piece);
  at_ += piece;
  if (last) {
    sending_ = false;
    odd_ = !odd_;
    due_ = due_ + interval_;
    ++number_;
    ++sent_;
  }
  return payload_;
}

}  // namespace onestroke::usb
