#include "tracking/motion_filter.h"

#include "core/pose_history.h"

#include <cmath>

namespace onestroke {
namespace {

// Of a turn (rad) and a shift (mm): standard deviations of a velocity that may be anything, of one that a picture told,
// of hands' accelerations, and of what poses are off by beyond what their covariances tell, which changes as the marker
// turns; and the root of the spectral density of the acceleration's change.
struct Hand {
  double any_velocity, told_velocity, acceleration, bias, jerk;
};
constexpr Hand turning{1e4, 0.5, 20, 1e-3, 40}, shifting{1e6, 60, 4000, 0.03, 5000};
// A hand's acceleration dies away in this time, seconds.
constexpr double lasting = 0.08;

// What an acceleration of 1 adds in a time to the place and to the velocity, and what is left of it.
struct Push {
  double place, velocity, left;
  explicit Push(double h) : left(std::exp(-h / lasting)) {
    velocity = lasting * (1 - left);
    place = lasting * (h - velocity);
  }
};

const Hand& hand(std::size_t axis) {
  return axis < 3 ? turning : shifting;
}

double& component(Velocity& v, std::size_t axis) {
  Vec3& part = axis < 3 ? v.angular : v.linear;
  const std::size_t i = axis % 3;
  return i == 0 ? part.x : i == 1 ? part.y : part.z;
}

double variance(const Matrix6d& covariance, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  return covariance(i, i);
}

// By which the covariance grows in a time.
Eigen::Matrix3d drift(double jerk, double h) {
  const double h2 = h * h, h3 = h2 * h, h4 = h3 * h, h5 = h4 * h;
  Eigen::Matrix3d q;
  q << h5 / 20, h4 / 8, h3 / 6, h4 / 8, h3 / 3, h2 / 2, h3 / 6, h2 / 2, h;
  return jerk * jerk * q;
}

// The covariance after a time.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance, const Push& push, double jerk, double seconds) {
  Eigen::Matrix3d passing;
  passing << 1, seconds, push.place, 0, 1, push.velocity, 0, 0, push.left;
  return passing * covariance * passing.transpose() + drift(jerk, seconds);
}

}  // namespace

void MotionFilter::start(const Pose& pose, const Matrix6d& covariance, const Velocity* velocity) {
  pose_ = pose;
  velocity_ = velocity ? *velocity : Velocity{};
  acceleration_ = {};
  moving_ = velocity != nullptr;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const Hand& of = hand(axis);
    const double fast = velocity ? of.told_velocity : of.any_velocity;
    covariance_[axis] =
        Eigen::Vector3d(variance(covariance, axis), fast * fast, of.acceleration * of.acceleration).asDiagonal();
  }
}

void MotionFilter::add(const Pose& pose, const Matrix6d& covariance, double seconds) {
  const Pose expected = predict(seconds);
  const Push push(seconds);
  const Vec3 turn = log_so3(pose.rotation * expected.rotation.conjugate());
  Velocity off{turn, pose.translation - expected.translation}, correction;
  for (std::size_t axis = 0; axis < 6; ++axis) {
    Covariance& c = covariance_[axis];
    const Hand& of = hand(axis);
    c = carried(c, push, of.jerk, seconds);
    const double measured = variance(covariance, axis) + of.bias * of.bias;
    const Eigen::Vector3d gain = c.col(0) / (c(0, 0) + measured);
    c -= gain * Eigen::RowVector3d(c.row(0));
    // Where nothing was known before, the difference drowns in rounding.
    c.col(0) = measured * gain;
    c.row(0) = c.col(0).transpose();
    const double surprise = component(off, axis);
    component(correction, axis) = gain[0] * surprise;
    double& acceleration = component(acceleration_, axis);
    component(velocity_, axis) += push.velocity * acceleration + gain[1] * surprise;
    acceleration = push.left * acceleration + gain[2] * surprise;
  }
  pose_ = {normalized(exp_so3(correction.angular) * expected.rotation), expected.translation + correction.linear};
  moving_ = true;
}

Pose MotionFilter::predict(double seconds) const {
  if (seconds <= 0) return pose_;
  const double share = Push(seconds).place / seconds;
  const Velocity mean{velocity_.angular + share * acceleration_.angular,
                      velocity_.linear + share * acceleration_.linear};
  return advance(pose_, mean, Duration::from_seconds(seconds));
}

Eigen::Matrix<double, 6, 1> MotionFilter::predicted_variance(double seconds) const {
  Eigen::Matrix<double, 6, 1> variances;
  for (std::size_t axis = 0; axis < 6; ++axis)
    variances[static_cast<Eigen::Index>(axis)] =
        carried(covariance_[axis], Push(seconds), hand(axis).jerk, seconds)(0, 0);
  return variances;
}

}  // namespace onestroke
