#include "display/openxr_head.h"

#include "scene/frames.h"

#include <pthread.h>

#include <chrono>
#include <tuple>

namespace onestroke {

namespace {

// As often as hand and head need to be told apart from a straight line between two samples.
constexpr std::chrono::milliseconds between_samples(4);
// Some runtimes say where the head is now, whatever the time that they are asked for; a late answer would be of
// another.
constexpr Duration longest_answer = Duration::from_ms(2);
// Two seconds.
constexpr std::size_t remembered = 512;

constexpr XrSpaceLocationFlags needed = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
constexpr XrSpaceVelocityFlags both = XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;

}  // namespace

OpenXrHead::OpenXrHead() : history_(remembered) {}

void OpenXrHead::attach(const OpenXrClock& clock, XrSession session, const OpenXrPlace& place) {
  detach();
  use(place);
  source_.emplace(clock, make_space(session, XR_REFERENCE_SPACE_TYPE_VIEW));
  follower_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "head");
    follow(stop);
  });
}

void OpenXrHead::use(const OpenXrPlace& place) {
  const std::scoped_lock lock(asking_);
  place_ = place;
}

void OpenXrHead::detach() {
  follower_ = {};
  source_.reset();
  forget();
}

void OpenXrHead::forget() {
  const std::scoped_lock lock(asking_);
  history_.clear();
}

void OpenXrHead::move(const Pose& T_new_old, const OpenXrPlace& place) {
  const std::scoped_lock lock(asking_);
  T_world_first_ = T_new_old * T_world_first_;
  place_ = place;
  ++moves_;
}

void OpenXrHead::follow(const std::stop_token& stop) noexcept {
  try {
    for (; !stop.stop_requested(); std::this_thread::sleep_for(between_samples)) sample();
  } catch (const OpenXrError&) {
    // The thread that renders finds out by itself that the runtime went away.
  }
}

void OpenXrHead::sample() {
  auto velocity = typed<XrSpaceVelocity>(XR_TYPE_SPACE_VELOCITY);
  auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  location.next = &velocity;
  const auto [around, T_world_first, moves] = [this] {
    const std::scoped_lock lock(asking_);
    return std::tuple(place_, T_world_first_, moves_);
  }();
  const Time now = Time::now();
  const XrTime now_runtime = source_->clock.to_runtime(now);
  check(xrLocateSpace(*source_->head, around.space, now_runtime, &location),
        "the OpenXR runtime does not say where the head is");
  if ((location.locationFlags & needed) != needed || Time::now() - now > longest_answer) return;
  // Not every runtime tells how fast the head moves.
  std::optional<Velocity> moving;
  if ((velocity.velocityFlags & both) == both)
    moving = {.angular = direction_from_graphics(vector_of(velocity.angularVelocity)),
              .linear = direction_from_graphics(vector_of(velocity.linearVelocity)) / metres_per_millimetre};
  const Pose T_first_space = inverse(T_world_first) * around.world.T_world_space(now_runtime);
  if (moving) {
    moving->angular = rotate(T_first_space.rotation, moving->angular);
    moving->linear = rotate(T_first_space.rotation, moving->linear);
  }
  const std::scoped_lock lock(asking_);
  // What was asked in a world that has moved meanwhile belongs to none.
  if (moves == moves_) history_.add(now, T_first_space * pose_of(location.pose), moving);
}

std::optional<Pose> OpenXrHead::at(Time time) const {
  const std::scoped_lock lock(asking_);
  const PoseHistory::Answer answer = history_.get(time);
  return answer.kind == PoseHistory::Kind::none ? std::nullopt : std::optional(T_world_first_ * answer.pose);
}

}  // namespace onestroke
