#pragma once

#include "tracking/clock_calibration.h"

#include <optional>
#include <span>

namespace onestroke {

/// The head's way between sights, in the order of their times: a cubic through neighbouring ones (Catmull and Rom), of
/// the rotation in the axes of the earlier one. The sights outlive it.
class HeadPath {
 public:
  /// Sights further apart than this do not follow one another.
  static constexpr Duration gap = Duration::from_ms(150);

  explicit HeadPath(std::span<const ClockSight> sights) : sights_(sights) {}

  /// None where no sights are near on both sides.
  std::optional<Pose> at(Time time) const;

 private:
  std::span<const ClockSight> sights_;
};

}  // namespace onestroke
