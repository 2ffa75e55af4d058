#include "tracking/head_path.h"

#include <algorithm>

namespace onestroke {
namespace {

struct Change {
  Vec3 turn, shift;
};

Change operator*(double k, const Change& c) {
  return {k * c.turn, k * c.shift};
}
Change operator+(const Change& a, const Change& b) {
  return {a.turn + b.turn, a.shift + b.shift};
}

/// From one sight's head to another's: the turn in the axes of the first, the shift in the world's.
Change change(const ClockSight& from, const ClockSight& to) {
  const Pose &a = from.sight.T_world_head, &b = to.sight.T_world_head;
  return {log_so3(a.rotation.conjugate() * b.rotation), b.translation - a.translation};
}

}  // namespace

std::optional<Pose> HeadPath::at(Time time) const {
  const auto after = std::ranges::upper_bound(sights_, time, {}, &ClockSight::time);
  if (after == sights_.begin() || after == sights_.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - sights_.begin());
  const ClockSight &a = sights_[i - 1], &b = sights_[i];
  const Duration step = b.time - a.time;
  if (step > gap) return std::nullopt;
  const Change to = change(a, b);
  // The change a step at sight k, seen from a; where it has one neighbour alone, that of this step.
  const auto slope = [&](std::size_t k) {
    if (k == 0 || k + 1 == sights_.size()) return to;
    const Duration span = sights_[k + 1].time - sights_[k - 1].time;
    if (span > 2 * gap) return to;
    return (step.seconds() / span.seconds()) * (change(a, sights_[k + 1]) + -1 * change(a, sights_[k - 1]));
  };
  const double s = (time - a.time).seconds() / step.seconds(), s2 = s * s, s3 = s2 * s;
  const Change way = (s3 - 2 * s2 + s) * slope(i - 1) + (3 * s2 - 2 * s3) * to + (s3 - s2) * slope(i);
  const Pose& from = a.sight.T_world_head;
  return Pose{from.rotation * exp_so3(way.turn), from.translation + way.shift};
}

}  // namespace onestroke
