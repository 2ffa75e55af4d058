#include "display/openxr_head.h"

#include "display/openxr_spaces.h"
#include "scene/frames.h"

namespace onestroke {

namespace {

// More than a second, at the fastest headset's rate.
constexpr std::size_t remembered = 256;
// Between two that ask.
constexpr std::size_t waiting = 64;
// How far back every runtime remembers (the OpenXR specification, xrLocateSpace).
constexpr Duration runtime_remembers = Duration::from_ms(50);

constexpr XrSpaceLocationFlags needed = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
constexpr XrSpaceVelocityFlags both = XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;

Vec3 vector_of(const XrVector3f& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

OpenXrHead::OpenXrHead() : samples_(waiting), history_(remembered) {}

void OpenXrHead::attach(const OpenXrClock& clock, XrSession session, XrSpace world) {
  const std::scoped_lock lock(asking_);
  source_.emplace(clock, make_space(session, XR_REFERENCE_SPACE_TYPE_VIEW), world);
}

void OpenXrHead::detach() {
  forget();
  const std::scoped_lock lock(asking_);
  source_.reset();
}

void OpenXrHead::forget() {
  const std::scoped_lock lock(asking_);
  samples_.drain([](Sample&) {});
  history_.clear();
}

std::optional<OpenXrHead::Sample> OpenXrHead::locate(Time time) const {
  auto velocity = typed<XrSpaceVelocity>(XR_TYPE_SPACE_VELOCITY);
  auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  location.next = &velocity;
  check(xrLocateSpace(*source_->head, source_->world, source_->clock.to_runtime(time), &location),
        "the OpenXR runtime does not say where the head is");
  if ((location.locationFlags & needed) != needed) return std::nullopt;
  Sample sample{.time = time, .pose = pose_of(location.pose), .velocity = {}};
  // Not every runtime tells how fast the head moves.
  if ((velocity.velocityFlags & both) == both)
    sample.velocity = {.angular = direction_from_graphics(vector_of(velocity.angularVelocity)),
                       .linear = direction_from_graphics(vector_of(velocity.linearVelocity)) / metres_per_millimetre};
  return sample;
}

void OpenXrHead::sample(Time now) {
  if (const auto here = locate(now)) samples_.push(*here);
}

std::optional<Pose> OpenXrHead::at(Time time) const {
  const std::scoped_lock lock(asking_);
  if (!source_) return std::nullopt;
  samples_.drain([this](Sample& s) { history_.add(s.time, s.pose, s.velocity); });
  try {
    if (Time::now() - time < runtime_remembers)
      if (const auto there = locate(time)) return there->pose;
  } catch (const OpenXrError&) {
    // The thread that renders finds out by itself that the runtime went away.
  }
  const PoseHistory::Answer answer = history_.get(time);
  return answer.kind == PoseHistory::Kind::none ? std::nullopt : std::optional(answer.pose);
}

}  // namespace onestroke
