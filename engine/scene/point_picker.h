#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <optional>

namespace onestroke {

/// Picks the places at which a point is held still for a moment. No allocation.
class PointPicker {
 public:
  /// A hand's tremor and the tracker's noise stay within this, mm.
  static constexpr double still_mm = 4;
  static constexpr Duration hold = Duration::from_ms(800);
  static constexpr Duration longest_gap = Duration::from_ms(250);
  /// A picked place must be left by this before another is, mm.
  static constexpr double left_mm = 10;

  /// One frame: where the point is, or nothing where it is out of sight or far from everything, which a short gap
  /// forgives. `now` does not go back. Returns a place once, when it is picked: the mean of where the point was held.
  std::optional<Vec3> update(const std::optional<Vec3>& point, Time now);
  /// Nothing is picked here until it is left.
  void leave_out(Vec3 place) { last_ = place, count_ = 0; }
  double progress() const { return progress_; }

 private:
  Vec3 mean_;
  int count_ = 0;
  Time since_, seen_;
  std::optional<Vec3> last_;
  double progress_ = 0;
};

}  // namespace onestroke
