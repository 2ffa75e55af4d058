#include "scene/measuring.h"

#include <cmath>
#include <numbers>

namespace onestroke {

void Measuring::begin(Vec3 tip_world, const Similarity& world_from_marker) {
  count_ = 0;
  picker_ = {};
  picker_.leave_out(inverse(world_from_marker) * tip_world);
}

void Measuring::update(const std::optional<Vec3>& tip_world, const Similarity& world_from_marker, double mm_scale,
                       Time now) {
  const Similarity marker_from_world = inverse(world_from_marker);
  if (tip_world) view_.tip_world = *tip_world;
  // Still is what stays on the model, however that moves.
  std::optional<Vec3> tip;
  if (tip_world) tip = marker_from_world * *tip_world;
  if (const std::optional<Vec3> picked = picker_.update(tip, now)) {
    // A fourth point begins anew.
    if (count_ == static_cast<int>(points_.size())) count_ = 0;
    points_[static_cast<std::size_t>(count_++)] = *picked;
  }
  view_.pick_progress = tip ? picker_.progress() : 0;
  fill(world_from_marker, mm_scale);
}

void Measuring::fill(const Similarity& world_from_marker, double mm_scale) {
  view_.count = count_;
  for (std::size_t i = 0; i < points_.size(); ++i) view_.points_world[i] = world_from_marker * points_[i];
  const Vec3 back = points_[0] - points_[1], on = points_[2] - points_[1];
  view_.distance = norm(back) / mm_scale;
  view_.distance_2 = norm(on) / mm_scale;
  view_.angle_deg = std::atan2(norm(cross(back, on)), dot(back, on)) * 180 / std::numbers::pi;
}

}  // namespace onestroke
