#pragma once

#include "core/pose.h"

#include <functional>
#include <string>
#include <vector>

namespace onestroke::accuracy {

/// A stick that stands still before the tracker, 500 mm away; after the first second.
struct Stillness {
  int pictures = 0, measured = 0;
  /// Standard deviations about the mean pose: of the rotation, degrees, of the marker's middle, mm, all three axes
  /// together.
  double turn_deg = 0, shift_mm = 0;
  /// The largest change of the rotation from picture to picture, degrees; and how far the mean is off the truth.
  double step_deg = 0, bias_deg = 0;
  /// Median of the normalised error squared by the reported covariance; 5.35 were exact.
  double nees = 0;
  double ms = 0;  ///< Median of a picture's time.
};
Stillness watch_still(int id, Quat rotation, double distance = 500, int pictures = 60);

/// A stick that moves as the function of seconds tells.
struct Lag {
  int pictures = 0, measured = 0;
  /// By which the rotation and the marker's middle reported are late, from least squares of the errors by the true
  /// velocities.
  double turn_ms = 0, shift_ms = 0;
  /// Root mean squares of the errors, and the largest one.
  double turn_deg = 0, shift_mm = 0, worst_deg = 0;
  /// As Stillness's.
  double nees = 0;
};
Lag watch_moving(int id, const std::function<Pose(double)>& T_camera_marker, double seconds,
                 double pictures_a_second = 30);

}  // namespace onestroke::accuracy
