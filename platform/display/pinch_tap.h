#pragma once

#include "core/time.h"

#include <optional>

namespace onestroke {

/// How far the thumb's tip is from two others, mm.
struct HandPinch {
  double forefinger_mm = 0, middle_finger_mm = 0;
};

/// Finds out when thumb and finger are tapped together: open, together, and open again at once. A hand that holds a
/// stick keeps them together, one that takes a stick up closes and stays so, and one that lays it down was not open
/// before: none of these is a tap. No allocation.
class PinchTap {
 public:
  static constexpr double together_mm = 18, open_mm = 40;
  static constexpr Duration open_before = Duration::from_ms(200), longest = Duration::from_ms(600);

  /// One frame: how far the tips are apart, nothing where the hand is not seen. `now` does not go back. True once, when
  /// a tap is over.
  bool update(const std::optional<double>& apart_mm, Time now);

 private:
  enum class Stage { unknown, open, together };

  Stage stage_ = Stage::unknown;
  Time since_;
};

/// The taps of one hand. Where the forefinger is at the thumb too, the middle finger has only gone along.
class HandTaps {
 public:
  enum class Tap { none, forefinger, middle_finger };

  Tap update(const std::optional<HandPinch>& hand, Time now);

 private:
  PinchTap forefinger_, middle_finger_;
};

}  // namespace onestroke
