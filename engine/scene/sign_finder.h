#pragma once

#include "scene/compare_modes.h"
#include "scene/hands.h"

#include <optional>

namespace onestroke {

/// What the sticks in both hands look like to the gestures.
struct StickPair {
  bool both_held = false;  ///< Neither has been out of sight for long.
  bool both_visible = false;
  std::array<StickPoints, 2> points{};  ///< Left, right; world, mm.
  Quat right_to_left;                   ///< The right stick's rotation in the left one's frame.
};

/// A sign that was made, or is being made.
struct MadeSign {
  Sign sign{};
  std::optional<Hand> pointer;  ///< Whose tip touches the other's corner or end; none where the two do alike.
};

/// A sign that the sticks are about to make or are making, and where.
struct OfferedSign {
  MadeSign made;
  Vec3 place_world;     ///< mm
  double progress = 0;  ///< 0 to 1.
};

/// Finds the signs that two sticks make in a mode: touches, parting, twisting, one going out of sight. What means
/// nothing in the mode is no sign. No allocation.
class SignFinder {
 public:
  /// Turned so far, for so long, one stick is twisted against the other; so little, it is no more.
  static constexpr double twisted_deg = 45, untwisted_deg = 25;
  static constexpr Duration twisted_for = Duration::from_ms(500);

  /// One frame; `now` does not go back. One sign a frame at most.
  std::optional<MadeSign> update(const StickPair& sticks, const CompareMode& mode, Time now);
  /// The sticks have changed hands.
  void exchange();
  /// Of this frame.
  const std::optional<OfferedSign>& offer() const { return offer_; }

 private:
  std::optional<Sign> watch_twist(const StickPair& sticks, const CompareMode& mode, Time now);
  void make_offer(const StickPair& sticks, const CompareMode& mode);

  TouchGesture touch_;
  std::optional<OfferedSign> offer_;
  bool corners_held_ = false, laid_over_ = false, twisted_ = false;
  Quat untwisted_;  // right to left, when the models were laid over each other
  std::optional<Time> twisting_since_;
  double twist_progress_ = 0;
};

}  // namespace onestroke
