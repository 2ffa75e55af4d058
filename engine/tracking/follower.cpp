#include "tracking/follower.h"

#include "core/pose_history.h"

#include <Eigen/LU>
#include <algorithm>

namespace onestroke {
namespace {

// Hands turn and move with accelerations up to about these (rad/s^2, mm/s^2); what a constant velocity misses grows
// with them.
constexpr double angular_acceleration = 20, linear_acceleration = 4000;
// The fastest that a hand brings a marker along (rad/s, mm/s).
constexpr double angular_speed = 12, linear_speed = 1500;
// After a gap this long a difference of poses says nothing of the motion now.
constexpr double max_gap_s = 0.25;
constexpr Duration max_prediction = Duration::from_ms(200);
// By what a prediction of the pose is off at most, radians and millimetres: what a few lines do not tell, as the roll
// about the one arm that is in sight, is that of the prediction.
constexpr double expected_turn = 0.15, expected_shift = 60;
// Of these, what a prediction is usually off by.
constexpr double usual = 0.3;
// A jerk, half as much again as the usual acceleration, and what noise adds to the prediction.
constexpr double jerk = 1.5, turn_slack = 0.12, shift_slack = 10;

// What a picture told by itself, where what was expected is counted in.
Matrix6d told_alone(const Matrix6d& together, const Matrix6d& expected) {
  return covariance_of(together.inverse() - expected.inverse());
}

}  // namespace

Pose Follower::predict(Time t) const {
  const Duration ahead = std::min(t - last_, max_prediction);
  return motion_.predict(ahead.seconds());
}

bool Follower::plausible(Time t, const Pose& T_world_marker) {
  if (phase_ != Phase::followed || near_prediction(t, T_world_marker)) return true;
  const double since = (t - doubted_).seconds();
  const bool again = since > 0 && since < max_gap_s &&
                     angle_between(T_world_doubted_.rotation, T_world_marker.rotation) < turn_slack &&
                     norm(T_world_doubted_.translation - T_world_marker.translation) < shift_slack;
  doubted_ = t;
  T_world_doubted_ = T_world_marker;
  if (again) forget();
  return again;
}

bool Follower::near_prediction(Time t, const Pose& T_world_marker) const {
  const Pose expected = predict(t);
  const double dt = (t - last_).seconds(), reach = 0.5 * jerk * dt * dt;
  // Until a velocity is known the marker may have been moving all along.
  const double unknown = motion_.moving() ? 0 : dt;
  return angle_between(expected.rotation, T_world_marker.rotation) <
             turn_slack + reach * angular_acceleration + unknown * angular_speed &&
         norm(expected.translation - T_world_marker.translation) <
             shift_slack + reach * linear_acceleration + unknown * linear_speed;
}

void Follower::measured(Time t, const PoseMeasurement& measurement, const Inks& inks, const Velocity* velocity,
                        const PoseMeasurement* sharp) {
  const double dt = (t - last_).seconds();
  const bool goes_on = phase_ == Phase::followed && dt > 0 && dt < max_gap_s;
  if (!goes_on) filter_.clear();
  const PoseFilter::Estimate& now = filter_.add(measurement, sharp);
  if (goes_on)
    motion_.add(now.pose,
                measurement.as_expected ? told_alone(now.covariance, expectation(t).covariance) : now.covariance, dt);
  else
    motion_.start(now.pose, now.covariance, velocity);
  phase_ = Phase::followed;
  last_ = t;
  T_world_marker_ = now.pose;
  inks_ = inks;
}

MotionPrior Follower::motion_prior(Time t) const {
  MotionPrior prior;
  if (!motion_.moving()) return prior;
  const double dt = (t - last_).seconds();
  prior.pose_information.diagonal().head<3>().setConstant(1 / (expected_turn * expected_turn));
  prior.pose_information.diagonal().tail<3>().setConstant(1 / (expected_shift * expected_shift));
  prior.angular = std::min(prior.angular, usual * angular_acceleration * dt);
  prior.linear = std::min(prior.linear, usual * linear_acceleration * dt);
  return prior;
}

PoseMeasurement Follower::expectation(Time t) const {
  return {predict(t), motion_.predicted_variance((t - last_).seconds()).asDiagonal()};
}

void Follower::missed(Time t, const TrackerOptions& options) {
  const Duration gap = t - last_;
  if (phase_ == Phase::unknown) return;
  if (gap > options.predict_for + options.report_lost_for)
    forget();
  else if (gap > options.predict_for)
    phase_ = Phase::lost;
}

Matrix6d Follower::predicted_covariance(Time t) const {
  const double dt = (t - last_).seconds();
  const double turn = 0.5 * angular_acceleration * dt * dt, shift = 0.5 * linear_acceleration * dt * dt;
  Matrix6d c = covariance();
  c.diagonal().head<3>().array() += turn * turn;
  c.diagonal().tail<3>().array() += shift * shift;
  return c;
}

}  // namespace onestroke
