#pragma once

#include "core/frame_record.h"
#include "tracking/head_calibration.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace onestroke {

/// Gathers the sights of a marker from which a head's camera is calibrated. Of several markers the one that is seen
/// most is taken.
class HeadSights {
 public:
  /// How many sights, and how far a head must have turned about two axes, for enough().
  static constexpr std::size_t wanted = 40;
  static constexpr double wanted_first_deg = 30, wanted_second_deg = 20;
  /// A head that turns faster tells more of the clocks than of the camera.
  static constexpr double fastest_deg_s = 60;

  /// A picture's markers, and where the head was in the middle of its exposure. Takes in those that are measured, and
  /// where the head stands elsewhere than before.
  void add(const FrameRecord& record, const Pose& T_world_head);

  std::span<const HeadSight> sights() const;
  /// Pictures with a marker so far, used or not.
  std::size_t seen() const { return seen_; }
  const HeadTurn& turn() const { return turn_; }
  /// 0 to 1.
  double progress() const;
  bool enough() const { return progress() >= 1; }
  /// What the wearer should do next, in a few words.
  std::string advice() const;

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
