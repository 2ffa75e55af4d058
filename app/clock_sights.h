#pragma once

#include "app/sights.h"
#include "tracking/clock_calibration.h"

#include <map>
#include <span>
#include <vector>

namespace onestroke {

/// Gathers the sights of a marker from which the offset between a camera's clock and its head's is found. Of several
/// markers the one that is seen most is taken.
class ClockSights final : public Sights {
 public:
  /// How many sights with a head that turns fast enough are enough.
  static constexpr std::size_t wanted = 240;

  void add(const FrameRecord& record, const Pose& T_world_head) override;
  std::size_t seen() const override { return seen_; }
  double progress() const override;
  std::string advice() const override;
  /// In the order of their times.
  std::span<const ClockSight> sights() const;

 private:
  std::map<int, std::vector<ClockSight>> by_marker_;
  std::size_t seen_ = 0, fast_ = 0;
};

}  // namespace onestroke
