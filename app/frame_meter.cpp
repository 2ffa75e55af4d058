#include "app/frame_meter.h"

#include <algorithm>

namespace onestroke {
namespace {

constexpr Duration counted_over = Duration::from_ms(500);
constexpr Duration aged_over = Duration::from_seconds(1);

}  // namespace

void FrameMeter::update(const Moment& moment) {
  if (moment.new_picture) {
    ++pictures_;
    figures_.tracker_ms += 0.1 * (moment.record.cost.ms() - figures_.tracker_ms);
  }
  if (moment.age) ages_[ages_count_++ % ages_.size()] = {moment.now, *moment.age};
  figures_.left_out = moment.left_out;
  ++frames_;
  if (since_.ns == 0) since_ = moment.now;
  const Duration span = moment.now - since_;
  if (span < counted_over) return;
  figures_.pictures_a_second = pictures_ / span.seconds();
  figures_.frames_a_second = frames_ / span.seconds();
  figures_.age = median_age(moment.now);
  pictures_ = frames_ = 0;
  since_ = moment.now;
}

std::optional<Duration> FrameMeter::median_age(Time now) const {
  std::array<Duration, 256> recent;
  auto* end = recent.begin();
  for (std::size_t i = 0; i < std::min(ages_count_, ages_.size()); ++i)
    if (now - ages_[i].at <= aged_over) *end++ = ages_[i].age;
  if (end == recent.begin()) return std::nullopt;
  auto* middle = recent.begin() + (end - recent.begin()) / 2;
  std::nth_element(recent.begin(), middle, end);
  return *middle;
}

}  // namespace onestroke
