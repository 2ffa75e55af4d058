#pragma once

#include "core/frame_record.h"

#include <array>

namespace onestroke {

enum class Hand { left = 0, right = 1 };

inline constexpr std::array<Hand, 2> both_hands{Hand::left, Hand::right};

constexpr Hand other(Hand h) {
  return h == Hand::left ? Hand::right : Hand::left;
}

constexpr const char* name_of(Hand h) {
  return h == Hand::left ? "left" : "right";
}

/// The stick in one hand.
struct HeldMarker {
  bool held = false;
  int id = 0;
  std::array<char, max_name_length + 1> name{};
  MarkerState state = MarkerState::lost;
  Pose T_world_marker;  ///< The last known one.
  double image_x = 0;   ///< x / z in the camera when last seen.
  Time seen;            ///< When last measured or predicted.
  Time measured;        ///< When last measured; when taken up, where it was not measured then.

  bool visible() const { return held && state != MarkerState::lost; }
};

/// Tells which marker the left and which the right hand holds. A marker keeps its hand while it is seen and for a while
/// after; hands are exchanged only where the sticks have clearly been on each other's side for a while, so that
/// crossing them does not exchange anything.
class Hands {
 public:
  /// Sticks this far past each other (x / z in the image: 0.1 is 40 mm at 400 mm) for this long change hands.
  static constexpr double crossed = 0.1;
  static constexpr Duration crossed_for = Duration::from_ms(800);
  /// A stick that has been out of sight for so long leaves its hand free for another.
  static constexpr Duration forgotten_after = Duration::from_ms(1500);

  /// Returns true where the two sticks changed hands. No allocation.
  bool update(const FrameRecord& record, Time now);

  /// Gives each hand the other's stick, which then counts as its own side's. False where not both hold one.
  bool exchange();

  const HeldMarker& operator[](Hand h) const { return held_[static_cast<std::size_t>(h)]; }

 private:
  HeldMarker& at(Hand h) { return held_[static_cast<std::size_t>(h)]; }
  void follow_held(const FrameRecord& record, Time now);
  void take_up_new(const FrameRecord& record, Time now);
  bool exchange_when_crossed(Time now);

  std::array<HeldMarker, 2> held_;
  bool crossing_ = false;
  bool exchanged_ = false;  // the left hand holds what is on the right, and that is meant
  Time crossing_since_;
};

}  // namespace onestroke
