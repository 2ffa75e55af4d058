#pragma once

#include "core/pose.h"
#include "core/time.h"

namespace onestroke {

/// 0 to 1 without a kink at either end; u is clamped.
double smooth_step(double u);

/// A rotation that follows another. When it is given another one to follow it goes over in `length`, without a jump,
/// while both may keep turning.
class BlendedRotation {
 public:
  static constexpr Duration length = Duration::from_ms(150);

  /// Follows `target` from now on, going over from what is shown.
  void go_over_to(Quat target, Time now);
  /// Follows `target` at once.
  void set(Quat target);
  /// The rotation to show. To be called once a frame with what is followed.
  Quat update(Quat target, Time now);
  Quat shown() const { return shown_; }

 private:
  Quat shown_;
  Vec3 rest_;  // What is left to go, as the rotation vector from target to shown at the start.
  Time start_;
};

/// Where a model is shown: turned and sized about its middle.
struct ModelPlace {
  Quat rotation;
  Vec3 middle;  ///< World, mm.
  double scale = 1;
};

/// A place that follows another, as BlendedRotation does.
class BlendedPlace {
 public:
  static constexpr Duration length = BlendedRotation::length;

  void go_over_to(const ModelPlace& target, Time now);
  void set(const ModelPlace& target);
  const ModelPlace& update(const ModelPlace& target, Time now);
  const ModelPlace& shown() const { return shown_; }

 private:
  BlendedRotation rotation_;
  ModelPlace shown_;
  Vec3 rest_middle_;
  double rest_log_scale_ = 0;
  Time start_;
};

/// A switch that goes over without a kink.
class Eased {
 public:
  static constexpr Duration usual = Duration::from_ms(150);

  /// `in` and `out`: how long the whole way takes.
  void update(bool on, Duration step, Duration in = usual, Duration out = usual);
  void reset() { linear_ = 0; }
  double value() const { return smooth_step(linear_); }

 private:
  double linear_ = 0;
};

/// How far a stick is turning: the angle to its own smoothed past, radians. A steady turn of w rad/s gives w * memory.
class TurnMeter {
 public:
  static constexpr Duration memory = Duration::from_ms(400);

  void reset(Quat q) { past_ = q, angle_ = 0; }
  void update(Quat q, Duration step);
  double angle() const { return angle_; }

 private:
  Quat past_;
  double angle_ = 0;
};

}  // namespace onestroke
