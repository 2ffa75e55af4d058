#pragma once

#include "core/picture.h"
#include "tracking/camera_model.h"
#include "tracking/image_view.h"

namespace onestroke {

/// When each row of a picture was exposed, against the middle row's mid-exposure: seconds.
struct RowClock {
  double seconds_per_row = 0, middle_row = 0;

  RowClock() = default;
  RowClock(const Exposure& exposure, int height)
      : seconds_per_row(height > 1 ? exposure.readout.seconds() / (height - 1) : 0), middle_row(height / 2.0) {}

  bool rolls() const { return seconds_per_row != 0; }
  /// At a pixel's v (pixel centres at half-integers).
  double at(double v) const { return seconds_per_row * (v - middle_row); }
};

/// A picture with the camera that took it.
struct TimedView {
  ImageView image;
  Intrinsics intrinsics;
  RowClock clock;
};

/// A pose and how it changes: the marker turns about an axis that stands still in camera axes and moves along it, as it
/// does on a turntable and, for some milliseconds, in a hand.
struct Motion {
  EigenPose pose;                 ///< At the middle row's mid-exposure.
  Vec3d angular = Vec3d::Zero();  ///< rad/s, camera axes.
  Vec3d linear = Vec3d::Zero();   ///< Of the marker's origin, mm/s.

  /// The pose some seconds later.
  EigenPose at(double seconds) const;
  /// The velocity of a point of the marker, given in camera axes, mm/s.
  Vec3d velocity_of(const Vec3d& point) const { return linear + angular.cross(point - pose.t); }
  /// A point of that velocity goes seconds * (velocity + seconds * bend).
  Vec3d bend(const Vec3d& velocity, double seconds) const;
};

/// The same as project() below where the shutter rolls.
bool project_rolling(const Intrinsics& k, const RowClock& clock, const Motion& motion, const Vec3d& point,
                     Vec2d& pixel);

/// Projects a point of a moving marker, given where it is when the middle row is exposed, at the time when the row that
/// it falls on is.
inline bool project(const Intrinsics& k, const RowClock& clock, const Motion& motion, const Vec3d& point,
                    Vec2d& pixel) {
  return clock.rolls() ? project_rolling(k, clock, motion, point, pixel) : project(k, point, pixel);
}

}  // namespace onestroke
