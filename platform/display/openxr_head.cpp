#include "display/openxr_head.h"

#include "display/openxr_spaces.h"
#include "scene/frames.h"

#include <pthread.h>

#include <chrono>

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

Vec3 vector_of(const XrVector3f& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

OpenXrHead::OpenXrHead() : history_(remembered) {}

void OpenXrHead::attach(const OpenXrClock& clock, XrSession session, XrSpace space) {
  detach();
  place({});
  source_.emplace(clock, make_space(session, XR_REFERENCE_SPACE_TYPE_VIEW), space);
  follower_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "head");
    follow(stop);
  });
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

void OpenXrHead::place(const Pose& T_world_space) {
  const std::scoped_lock lock(asking_);
  T_world_space_ = T_world_space;
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
  const Time now = Time::now();
  check(xrLocateSpace(*source_->head, source_->space, source_->clock.to_runtime(now), &location),
        "the OpenXR runtime does not say where the head is");
  if ((location.locationFlags & needed) != needed || Time::now() - now > longest_answer) return;
  // Not every runtime tells how fast the head moves.
  std::optional<Velocity> moving;
  if ((velocity.velocityFlags & both) == both)
    moving = {.angular = direction_from_graphics(vector_of(velocity.angularVelocity)),
              .linear = direction_from_graphics(vector_of(velocity.linearVelocity)) / metres_per_millimetre};
  const std::scoped_lock lock(asking_);
  history_.add(now, pose_of(location.pose), moving);
}

std::optional<Pose> OpenXrHead::at(Time time) const {
  const std::scoped_lock lock(asking_);
  const PoseHistory::Answer answer = history_.get(time);
  return answer.kind == PoseHistory::Kind::none ? std::nullopt : std::optional(T_world_space_ * answer.pose);
}

}  // namespace onestroke
