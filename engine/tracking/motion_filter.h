#pragma once

#include "core/pose.h"
#include "tracking/camera_model.h"

#include <array>

namespace onestroke {

/// How a marker moves, from where it was: a Kalman filter of place, velocity and acceleration for each axis of the
/// world, the acceleration dying away and driven by white noise (Singer's model: Bar-Shalom, Li, Kirubarajan,
/// Estimation with Applications to Tracking and Navigation, 8.2.3). What pictures tell well it follows at once; where
/// they tell little, as of the tilt of an arm that points at the camera, it goes on as before.
class MotionFilter {
 public:
  /// Starts anew at a pose. The velocity, world axes, is 0 and may be anything where it is nullptr.
  void start(const Pose& pose, const Matrix6d& covariance, const Velocity* velocity);
  /// Takes in a pose measured `seconds` after the last one, more than 0.
  void add(const Pose& pose, const Matrix6d& covariance, double seconds);

  /// Two poses have been measured, or one with its velocity.
  bool moving() const { return moving_; }
  /// At the last measurement.
  const Velocity& velocity() const { return velocity_; }
  /// The pose after `seconds`.
  Pose predict(double seconds) const;
  /// The variances of that, about and along the world's axes.
  Eigen::Matrix<double, 6, 1> predicted_variance(double seconds) const;

 private:
  // Of place, velocity and acceleration about one axis.
  using Covariance = Eigen::Matrix3d;

  Velocity acceleration_;
  Velocity velocity_;
  Pose pose_;
  bool moving_ = false;
  std::array<Covariance, 6> covariance_{};
};

}  // namespace onestroke
