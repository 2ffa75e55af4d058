#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <array>
#include <cstddef>
#include <optional>

namespace onestroke {

/// The places of a bent stick that another one can touch. The start arm, away from its ends, is touched by another's
/// alone.
enum class StickPoint { start, corner, end, arm };

/// Where the first three are in the world, by StickPoint; mm.
using StickPoints = std::array<Vec3, 3>;

/// Where any of them is; of an arm, its middle.
Vec3 place_of(const StickPoints& stick, StickPoint p);

/// Which place of the left stick and which of the right one are held together.
struct Touch {
  StickPoint left = StickPoint::corner, right = StickPoint::corner;

  friend bool operator==(const Touch&, const Touch&) = default;
};

/// Finds out when two sticks are held together on purpose: two of their places near each other, hardly moving against
/// each other, for a moment. After a touch has counted, the sticks must part before another one can. Short drop-outs of
/// the tracker hold a touch up, but do not break it off. No allocation.
class TouchGesture {
 public:
  /// A tip is a rod's thickness wide and touches to a few millimetres; corners are bent, and fingers are near them.
  static constexpr double near_mm = 14, near_corners_mm = 30;
  /// What is held together may go so much farther apart before it counts as let go.
  static constexpr double hold_factor = 1.3;
  /// From so much farther away a touch is spoken of.
  static constexpr double approach_factor = 3;
  /// Other places must be so much farther apart than those that are meant.
  static constexpr double clearly_nearer = 1.5;
  static constexpr double parted_factor = 1.8;
  /// Faster than this, of one place against the other, nothing is being held; mm/s.
  static constexpr double still_mm_s = 50;
  static constexpr Duration hold = Duration::from_ms(800);
  static constexpr Duration longest_gap = Duration::from_ms(250);

  /// One frame; nothing where a stick is out of sight. `now` does not go back. Returns a touch once, when it is
  /// complete.
  std::optional<Touch> update(const std::optional<std::array<StickPoints, 2>>& sticks, Time now);

  /// The sticks have changed hands: what was left is right from now on.
  void exchange();

  /// The touch that is being made or would be next, for something to be shown at it; none where none is near.
  const std::optional<Touch>& candidate() const { return candidate_; }
  /// As candidate(), and from farther away: what the sticks are about to do, for words to be shown at it.
  const std::optional<Touch>& approached() const { return approached_; }
  /// 0 at rest, growing to 1 when the touch is complete.
  double progress() const { return progress_; }
  /// Whether the touch that counted last is still held.
  bool held() const { return !armed_; }

  /// How near two places must come.
  static double near(Touch touch);

 private:
  struct Nearest {
    Touch touch{};
    double distance = 0, second = 0;  // over how near those places must come
    Vec3 between{};
  };
  static Nearest nearest(const std::array<StickPoints, 2>& sticks);
  static double distance(const std::array<StickPoints, 2>& sticks, Touch touch);
  void let_go();

  std::optional<Touch> candidate_, approached_;
  bool armed_ = true;
  Touch last_;  // that counted
  Duration held_for_;
  double progress_ = 0;
  Vec3 between_;  // from the left place to the right one, as it was a moment ago
  Time seen_;
};

}  // namespace onestroke
