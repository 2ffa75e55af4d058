#include "tracking/follower.h"

#include "core/pose_history.h"

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
constexpr double max_acceleration_s = 0.05;
// Of these, what a prediction is usually off by.
constexpr double usual = 0.3;
// A jerk, half as much again as the usual acceleration, and what noise adds to the prediction.
constexpr double jerk = 1.5, turn_slack = 0.12, shift_slack = 10;

Velocity plus(const Velocity& v, double factor, const Velocity& w) {
  return {v.angular + factor * w.angular, v.linear + factor * w.linear};
}

}  // namespace

Pose Follower::predict(Time t) const {
  const Duration ahead = std::min(t - last_, max_prediction);
  const double h = ahead.seconds(), u = std::min(h, max_acceleration_s);
  return advance(T_world_marker_, h > 0 ? plus(velocity_, u - u * u / (2 * h), acceleration_) : velocity_, ahead);
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
  const double unknown = moving_ ? 0 : dt;
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
  const Pose& now = filter_.add(measurement, sharp).pose;
  if (goes_on) {
    learn_velocity(velocity_between(T_world_marker_, now, t - last_), dt);
    moving_ = true;
  } else {
    acceleration_ = {};
    velocity_ = mean_velocity_ = velocity ? *velocity : Velocity{};
    moving_ = velocity != nullptr;
  }
  phase_ = Phase::followed;
  last_ = t;
  T_world_marker_ = now;
  inks_ = inks;
}

// What the change of the velocity says of the acceleration, as far as it stands out of what the measurements' own
// errors would make of it (Wiener's factor).
void Follower::learn_velocity(const Velocity& mean, double dt) {
  const Velocity before = moving_ ? mean_velocity_ : mean;
  const auto learn = [&](Vec3 from, Vec3 to, Eigen::Index first) {
    const Vec3 a = (to - from) / dt;
    const double variance = covariance().diagonal().segment<3>(first).sum();
    const double noise = 6 * variance / (dt * dt * dt * dt), signal = std::max(0.0, dot(a, a) - noise);
    return signal / (signal + noise + 1e-12) * a;
  };
  acceleration_ = {learn(before.angular, mean.angular, 0), learn(before.linear, mean.linear, 3)};
  mean_velocity_ = mean;
  velocity_ = plus(mean, dt / 2, acceleration_);
}

VelocityPrior Follower::velocity_prior(Time t) const {
  VelocityPrior prior;
  if (!moving_) return prior;
  const double dt = (t - last_).seconds();
  prior.angular = std::min(prior.angular, usual * angular_acceleration * dt);
  prior.linear = std::min(prior.linear, usual * linear_acceleration * dt);
  return prior;
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
