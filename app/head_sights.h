#pragma once

#include "app/sights.h"
#include "tracking/head_calibration.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace onestroke {

/// Gathers the sights of a marker from which a head's camera is calibrated. Of several markers the one that is seen
/// most is taken.
class HeadSights final : public Sights {
 public:
  /// How many sights, and how far a head must have turned about two axes, for enough().
  static constexpr std::size_t wanted = 40;
  static constexpr double wanted_first_deg = 30, wanted_second_deg = 20;
  /// A head that turns faster tells more of the clocks than of the camera.
  static constexpr double fastest_deg_s = 60;

  /// Takes in markers that are measured, where the head stands elsewhere than before.
  void add(const FrameRecord& record, const Pose& T_world_head) override;

  std::span<const HeadSight> sights() const;
  std::size_t seen() const override { return seen_; }
  const HeadTurn& turn() const { return turn_; }
  double progress() const override;
  std::string advice() const override;

 private:
  bool too_fast(Time time, const Pose& T_world_head);

  std::map<int, std::vector<HeadSight>> by_marker_;
  int most_ = 0;  // the marker with most sights
  std::size_t seen_ = 0;
  HeadTurn turn_;
  std::optional<Time> time_;
  Pose head_;
};

}  // namespace onestroke
