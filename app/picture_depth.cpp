#include "app/picture_depth.h"

#include <algorithm>

namespace onestroke {

std::span<const DepthSegment> PictureDepth::update(const FrameRecord& record, Time now) {
  const double step = frames_.step_to(now).seconds() / eases.seconds();
  for (Stick& stick : sticks_) stick.seen = false;
  for (const MarkerObservation& m : record.seen())
    if (m.state != MarkerState::lost) see(m);
  count_ = 0;
  for (Stick& stick : sticks_) {
    stick.presence = std::clamp(stick.presence + (stick.seen ? step : -step), 0.0, 1.0);
    if (stick.seen || stick.presence > 0) add_segments(stick);
  }
  return {segments_.data(), count_};
}

void PictureDepth::see(const MarkerObservation& marker) {
  auto at = std::ranges::find_if(sticks_, [&](const Stick& s) { return s.id == marker.id && s.presence > 0; });
  if (at == sticks_.end())
    at = std::ranges::find_if(sticks_, [](const Stick& s) { return s.presence <= 0 && !s.seen; });
  if (at == sticks_.end()) return;
  at->id = marker.id;
  at->seen = true;
  at->T_camera_marker = marker.T_camera_marker;
}

// A stroke with more corners than there is room for is followed as far as that goes.
void PictureDepth::add_segments(const Stick& stick) {
  const ShelfEntry* entry = shelf_.find(stick.id);
  if (!entry) return;
  std::array<Vec3, most_corners> corners;
  const std::size_t count = std::min(entry->corners.size(), corners.size());
  std::transform(entry->corners.begin(), entry->corners.begin() + static_cast<std::ptrdiff_t>(count), corners.begin(),
                 [&stick](Vec3 corner) { return stick.T_camera_marker * corner; });
  count_ += chain_segments(std::span(corners).first(count), stick.presence, std::span(segments_).subspan(count_));
}

}  // namespace onestroke
