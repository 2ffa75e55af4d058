#pragma once

#include "core/time.h"

#include <optional>

namespace onestroke {

/// The gesture that links and unlinks the models: the two sticks' corners held together for a moment. After it has
/// worked the sticks must part before it can work again.
class LinkGesture {
 public:
  static constexpr double near_mm = 60;
  /// A trembling hand does not break off what it has begun nearer than near_mm.
  static constexpr double still_near_mm = 66;
  static constexpr double parted_mm = 90;
  static constexpr Duration hold = Duration::from_ms(600);

  /// distance: between the corners, mm; nothing where a stick is out of sight, which breaks the gesture off. Returns
  /// true once a gesture, when it is complete.
  bool update(std::optional<double> distance, Time now);
  /// 0 at rest, growing to 1 when the gesture is complete; 0 again after it.
  double progress() const { return progress_; }

 private:
  bool armed_ = true, holding_ = false;
  Time since_;
  double progress_ = 0;
};

}  // namespace onestroke
