#include "app/frame_meter.h"

#include <algorithm>
#include <span>

namespace onestroke {
namespace {

constexpr Duration counted_over = Duration::from_ms(500);
constexpr Duration recent = Duration::from_seconds(1);

}  // namespace

void FrameMeter::update(const Moment& moment) {
  if (moment.new_picture) {
    ++pictures_;
    figures_.tracker_ms += 0.1 * (moment.record.cost.ms() - figures_.tracker_ms);
  }
  if (moment.latency) ways_[ways_count_++ % ways_.size()] = {moment.now, *moment.latency};
  figures_.left_out = moment.left_out;
  ++frames_;
  if (since_.ns == 0) since_ = moment.now;
  const Duration span = moment.now - since_;
  if (span < counted_over) return;
  figures_.pictures_a_second = pictures_ / span.seconds();
  figures_.frames_a_second = frames_ / span.seconds();
  figures_.latency = median_latency(moment.now);
  pictures_ = frames_ = 0;
  since_ = moment.now;
}

std::optional<Latency> FrameMeter::median_latency(Time now) const {
  const auto ways = std::span(ways_).first(std::min(ways_count_, ways_.size()));
  const auto median = [&](Duration Latency::*part) -> std::optional<Duration> {
    std::array<Duration, 256> lengths;
    auto* end = lengths.begin();
    for (const Way& way : ways)
      if (now - way.at <= recent) *end++ = way.latency.*part;
    if (end == lengths.begin()) return std::nullopt;
    auto* middle = lengths.begin() + (end - lengths.begin()) / 2;
    std::nth_element(lengths.begin(), middle, end);
    return *middle;
  };
  const auto tracked = median(&Latency::tracked), drawn = median(&Latency::drawn), seen = median(&Latency::seen);
  if (!seen) return std::nullopt;
  return Latency{*tracked, *drawn, *seen};
}

}  // namespace onestroke
