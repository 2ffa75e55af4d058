#include "core/pose_history.h"

#include "core/error.h"

namespace onestroke {

Velocity velocity_between(const Pose& a, const Pose& b, Duration between) {
  const double seconds = between.seconds();
  return {log_so3(b.rotation * a.rotation.conjugate()) / seconds, (b.translation - a.translation) / seconds};
}

Pose advance(const Pose& pose, const Velocity& velocity, Duration by) {
  const double seconds = by.seconds();
  return {normalized(exp_so3(seconds * velocity.angular) * pose.rotation),
          pose.translation + seconds * velocity.linear};
}

PoseHistory::PoseHistory(std::size_t capacity, Duration horizon) : ring_(capacity), horizon_(horizon) {
  if (capacity == 0) throw Error("a pose history needs room for at least one sample");
}

std::size_t PoseHistory::first_at_or_after(Time time) const {
  std::size_t low = 0, high = size_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (sample(middle).time < time)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

void PoseHistory::add(Time time, const Pose& pose, std::optional<Velocity> velocity) {
  const Sample added{time, pose, velocity};
  std::size_t at = first_at_or_after(time);
  if (at < size_ && sample(at).time == time) {
    sample(at) = added;
    return;
  }
  if (size_ == ring_.size()) {
    if (at == 0) return;
    first_ = (first_ + 1) % ring_.size();
    --size_;
    --at;
  }
  ++size_;
  for (std::size_t i = size_ - 1; i > at; --i) sample(i) = sample(i - 1);
  sample(at) = added;
}

Velocity PoseHistory::velocity_at(std::size_t i) const {
  if (sample(i).velocity) return *sample(i).velocity;
  if (size_ < 2) return {};
  const std::size_t from = i > 0 ? i - 1 : 0;
  const Sample &a = sample(from), &b = sample(from + 1);
  return velocity_between(a.pose, b.pose, b.time - a.time);
}

PoseHistory::Answer PoseHistory::predict(Time time) const {
  const Sample& last = sample(size_ - 1);
  const Velocity velocity = velocity_at(size_ - 1);
  const Duration ahead = time - last.time;
  if (ahead > horizon_) return {Kind::none, advance(last.pose, velocity, horizon_), velocity};
  return {Kind::predicted, advance(last.pose, velocity, ahead), velocity};
}

PoseHistory::Answer PoseHistory::get(Time time) const {
  if (empty()) return {};
  const std::size_t at = first_at_or_after(time);
  if (at == size_) return predict(time);
  const Sample& after = sample(at);
  if (after.time == time) return {Kind::exact, after.pose, velocity_at(at)};
  if (at == 0) return {Kind::none, after.pose, velocity_at(0)};
  const Sample& before = sample(at - 1);
  const Duration span = after.time - before.time;
  const double u = (time - before.time).seconds() / span.seconds();
  return {Kind::interpolated, interpolate(before.pose, after.pose, u), velocity_between(before.pose, after.pose, span)};
}

}  // namespace onestroke
