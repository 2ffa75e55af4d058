#pragma once

#include "../core/random_pose.h"
#include "scene_fixture.h"
#include "tracking/appearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace onestroke::test {

/// The inks as the picture shows them at the true pose.
inline Inks inks_at(const Shot& shot, const RodModel& rod, const Pose& pose) {
  Inks inks;
  complete_inks(shot.view(), shot.intrinsics, rod, to_eigen(pose), inks);
  return inks;
}

/// Both arms well in sight, 300 to 400 mm away.
inline Pose random_view(RandomPose& random) {
  for (;;) {
    const Quat rotation = random.rotation();
    const Pose pose =
        about_middle(rotation, {random.uniform(-20, 20), random.uniform(-15, 15), random.uniform(300, 400)});
    if (arms_in_sight(pose)) return pose;
  }
}

/// The pose turned about the marker's middle and moved, as a first guess may be.
inline Pose disturbed(const Pose& pose, RandomPose& random, double degrees, double mm) {
  const Vec3 middle = pose * Vec3{24, -24, 0};
  const Quat turn = exp_so3(random.turn(degrees * radian));
  return about_middle(turn * pose.rotation, middle + mm * random.direction());
}

/// Calls check(rod, shot, truth, start) for pictures of sharp and of bent markers, `start` lying near the truth.
template <typename Check>
void for_disturbed_starts(Check check) {
  RandomPose random;
  for (const double bend : {0.0, 8.0}) {
    const MarkerSpec marker = angle_marker(2, bend);
    const RodModel rod(marker);
    for (int i = 0; i < 6; ++i) {
      SCOPED_TRACE(i);
      const Pose truth = random_view(random);
      check(rod, shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)}), truth,
            disturbed(truth, random, 1.5, 1));
    }
  }
}

/// A square of one colour, somewhat grained, in front of all: a finger, a glove.
inline void cover(Shot& shot, const Vec2d& middle, int half, std::array<int, 3> color) {
  const auto from = [&](double x) { return std::max(0, static_cast<int>(x) - half); };
  const auto to = [&](double x, int size) { return std::min(size, static_cast<int>(x) + half); };
  for (int y = from(middle.y()); y < to(middle.y(), shot.image.height); ++y)
    for (int x = from(middle.x()); x < to(middle.x(), shot.image.width); ++x)
      for (int c = 0; c < 3; ++c)
        shot.image.rgb[static_cast<std::size_t>(3 * (y * shot.image.width + x) + c)] =
            static_cast<std::uint8_t>(color[static_cast<std::size_t>(c)] - 4 + (7 * x + 11 * y) % 9);
}

/// The stop arm points at the camera, but for `degrees`; the start arm lies across the picture.
inline Pose end_on_view(double degrees, double distance) {
  const Mat3 m{{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}}};
  const Quat away = exp_so3({degrees * radian, 0.6 * degrees * radian, 0});
  return about_middle(away * to_quat(m), {0, 0, distance});
}

}  // namespace onestroke::test
