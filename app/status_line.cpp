#include "app/status_line.h"

namespace onestroke {
namespace {

constexpr Duration counted_over = Duration::from_ms(500);

}  // namespace

std::string_view StatusLine::update(const FrameRecord& record, bool new_picture, std::uint64_t dropped, Time now) {
  if (new_picture) {
    ++pictures_;
    tracker_ms_ += 0.1 * (record.cost.ms() - tracker_ms_);
  }
  ++frames_;
  if (since_.ns == 0) since_ = now;
  const Duration span = now - since_;
  if (span >= counted_over) {
    pictures_a_second_ = pictures_ / span.seconds();
    frames_a_second_ = frames_ / span.seconds();
    pictures_ = frames_ = 0;
    since_ = now;
  }
  if (rates_)
    line_.print("Tracker %.1f ms · %.0f pictures/s · %.0f frames/s · %llu pictures left out", tracker_ms_,
                pictures_a_second_, frames_a_second_, static_cast<unsigned long long>(dropped));
  else
    line_.print("Tracker %.1f ms a picture", tracker_ms_);
  return line_.view();
}

}  // namespace onestroke
