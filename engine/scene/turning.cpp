#include "scene/turning.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3 - 2 * u);
}

void BlendedRotation::go_over_to(Quat target, Time now) {
  rest_ = log_so3(normalized(shown_ * target.conjugate()));
  start_ = now;
}

void BlendedRotation::set(Quat target) {
  shown_ = target;
  rest_ = {};
}

Quat BlendedRotation::update(Quat target, Time now) {
  const double left = 1 - smooth_step((now - start_).seconds() / length.seconds());
  shown_ = left > 0 ? normalized(exp_so3(left * rest_) * target) : target;
  return shown_;
}

void TurnMeter::update(Quat q, Duration step) {
  const double u = 1 - std::exp(-std::max(step.seconds(), 0.0) / memory.seconds());
  past_ = interpolate({past_, {}}, {q, {}}, u).rotation;
  angle_ = angle_between(past_, q);
}

}  // namespace onestroke
