#include "app/clock_sights.h"

#include <algorithm>
#include <numbers>

namespace onestroke {

void ClockSights::add(const FrameRecord& record, const Pose& T_world_head) {
  for (const MarkerObservation& marker : record.seen()) {
    if (!tells_pose(marker)) continue;
    std::vector<ClockSight>& sights = by_marker_[marker.id];
    if (!sights.empty() && record.time <= sights.back().time) continue;
    ++seen_;
    sights.push_back({record.time, {T_world_head, marker.T_camera_marker, marker.covariance}});
    if (sights.size() < 2 || sights.size() < this->sights().size()) continue;
    const double speed = median_turn_speed(std::span(sights).last(2)) * 180 / std::numbers::pi;
    if (speed >= slowest_clock_turn_deg_s) ++fast_;
  }
}

std::span<const ClockSight> ClockSights::sights() const {
  const auto most = std::ranges::max_element(by_marker_, {}, [](const auto& entry) { return entry.second.size(); });
  return most == by_marker_.end() ? std::span<const ClockSight>() : most->second;
}

double ClockSights::progress() const {
  return std::min(1.0, static_cast<double>(fast_) / wanted);
}

std::string ClockSights::advice() const {
  if (seen_ == 0) return "look at a marker that lies still";
  return "keep the marker in sight, and turn your head to and fro, about once a second, and nod as well";
}

}  // namespace onestroke
