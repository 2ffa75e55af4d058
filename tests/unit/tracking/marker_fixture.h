#pragma once

#include "camera/sensor.h"
#include "core/pose.h"
#include "marker/catalog.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

namespace onestroke::test {

inline constexpr double radian = std::numbers::pi / 180;

inline MarkerSpec angle_marker(int id, double bend_radius = 0) {
  const std::uint64_t value = scramble(static_cast<std::uint64_t>(id)) & ((1ULL << 34) - 1);
  return {id, "m" + std::to_string(id), encode(value, 36), Shape::angle(36, 4, 3, bend_radius), ""};
}

inline Catalog catalog_of(int markers) {
  Catalog catalog;
  for (int id = 1; id <= markers; ++id) catalog.markers.push_back(angle_marker(id));
  return catalog;
}

/// A pose that puts the middle of an angle at `middle`, turned by `rotation` about it.
inline Pose about_middle(Quat rotation, Vec3 middle) {
  return {rotation, middle - rotate(rotation, {24, -24, 0})};
}

/// Both arms are seen at 20 degrees or more from their axes.
inline bool arms_in_sight(const Pose& pose) {
  const Vec3 view = normalized(pose * Vec3{24, -24, 0});
  const double limit = std::cos(20 * radian);
  return std::abs(dot(view, rotate(pose.rotation, {1, 0, 0}))) < limit &&
         std::abs(dot(view, rotate(pose.rotation, {0, 1, 0}))) < limit;
}

/// Angle of the rotation between two poses, degrees.
inline double turn_between(const Pose& a, const Pose& b) {
  return angle_between(a.rotation, b.rotation) / radian;
}

/// How far the middle of an angle lies off, as a share of its distance.
inline double shift_between(const Pose& found, const Pose& truth) {
  const Vec3 middle{24, -24, 0};
  return norm(found * middle - truth * middle) / norm(truth * middle);
}

}  // namespace onestroke::test
