#include "app/head_sights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

constexpr double degree = std::numbers::pi / 180;

}  // namespace

bool HeadSights::too_fast(Time time, const Pose& T_world_head) {
  const Duration since = time_ ? time - *time_ : Duration{};
  const double turned = angle_between(T_world_head.rotation, head_.rotation) / degree;
  time_ = time;
  head_ = T_world_head;
  return since > Duration{} && turned > fastest_deg_s * since.seconds();
}

void HeadSights::add(const FrameRecord& record, const Pose& T_world_head) {
  const bool fast = too_fast(record.time, T_world_head);
  for (const MarkerObservation& marker : record.seen()) {
    if (!tells_pose(marker)) continue;
    ++seen_;
    std::vector<HeadSight>& sights = by_marker_[marker.id];
    const auto stood = [&](const HeadSight& sight) { return heads_alike(sight.T_world_head, T_world_head); };
    if (fast || std::ranges::any_of(sights, stood)) continue;
    sights.push_back({T_world_head, marker.T_camera_marker, marker.covariance});
    if (sights.size() < this->sights().size()) continue;
    most_ = marker.id;
    turn_ = head_turn(sights);
  }
}

std::span<const HeadSight> HeadSights::sights() const {
  const auto found = by_marker_.find(most_);
  return found == by_marker_.end() ? std::span<const HeadSight>() : found->second;
}

double HeadSights::progress() const {
  const std::array parts{static_cast<double>(sights().size()) / wanted, turn_.first_deg / wanted_first_deg,
                         turn_.second_deg / wanted_second_deg};
  return std::min(1.0, *std::ranges::min_element(parts));
}

std::string HeadSights::advice() const {
  if (seen_ == 0) return "look at a marker that lies still";
  if (turn_.first_deg < wanted_first_deg) return "keep the marker in sight, and turn your head slowly, left and right";
  if (turn_.second_deg < wanted_second_deg) return "now nod, and tilt your head";
  return "go on, also from other places";
}

}  // namespace onestroke
