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

void BlendedPlace::go_over_to(const ModelPlace& target, Time now) {
  rotation_.go_over_to(target.rotation, now);
  rest_middle_ = shown_.middle - target.middle;
  rest_log_scale_ = std::log(shown_.scale / target.scale);
  start_ = now;
}

void BlendedPlace::set(const ModelPlace& target) {
  rotation_.set(target.rotation);
  shown_ = target;
  rest_middle_ = {};
  rest_log_scale_ = 0;
}

const ModelPlace& BlendedPlace::update(const ModelPlace& target, Time now) {
  const double left = 1 - smooth_step((now - start_).seconds() / length.seconds());
  shown_ = {rotation_.update(target.rotation, now), target.middle + left * rest_middle_,
            target.scale * std::exp(left * rest_log_scale_)};
  return shown_;
}

void Eased::update(bool on, Duration step, Duration in, Duration out) {
  const double change = on ? step.seconds() / in.seconds() : -step.seconds() / out.seconds();
  linear_ = std::clamp(linear_ + change, 0.0, 1.0);
}

void TurnMeter::update(Quat q, Duration step) {
  const double u = 1 - std::exp(-std::max(step.seconds(), 0.0) / memory.seconds());
  past_ = interpolate({past_, {}}, {q, {}}, u).rotation;
  angle_ = angle_between(past_, q);
}

}  // namespace onestroke
