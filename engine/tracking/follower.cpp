#include "tracking/follower.h"

#include "core/pose_history.h"

namespace onestroke {
namespace {

// Hands turn and move with accelerations up to about these (rad/s^2, mm/s^2); what a constant velocity misses grows
// with them.
constexpr double angular_acceleration = 20, linear_acceleration = 4000;
// After a gap this long a difference of poses says nothing of the motion now.
constexpr double max_gap_s = 0.25;

}  // namespace

Pose Follower::predict(Time t) const {
  return advance(T_world_marker_, velocity_, t - last_);
}

void Follower::measured(Time t, const Pose& T_world_marker, const Inks& inks,
                        const std::array<double, 36>& covariance) {
  const double dt = (t - last_).seconds();
  if (phase_ == Phase::followed && dt > 0 && dt < max_gap_s) {
    velocity_ = velocity_between(T_world_marker_, T_world_marker, t - last_);
  } else {
    velocity_ = {};
  }
  phase_ = Phase::followed;
  last_ = t;
  T_world_marker_ = T_world_marker;
  inks_ = inks;
  covariance_ = covariance;
}

void Follower::missed(Time t, const TrackerOptions& options) {
  const Duration gap = t - last_;
  if (phase_ == Phase::unknown) return;
  if (gap > options.predict_for + options.report_lost_for)
    forget();
  else if (gap > options.predict_for)
    phase_ = Phase::lost;
}

std::array<double, 36> Follower::predicted_covariance(Time t) const {
  const double dt = (t - last_).seconds();
  const double turn = 0.5 * angular_acceleration * dt * dt, shift = 0.5 * linear_acceleration * dt * dt;
  std::array<double, 36> c = covariance_;
  for (std::size_t i = 0; i < 6; ++i) c[7 * i] += i < 3 ? turn * turn : shift * shift;
  return c;
}

}  // namespace onestroke
