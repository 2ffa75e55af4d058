#include "display/openxr_head.h"

#include "display/openxr_spaces.h"
#include "scene/frames.h"

namespace onestroke {

namespace {

// More than a second, at the fastest headset's rate.
constexpr std::size_t remembered = 256;

constexpr XrSpaceLocationFlags needed = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
constexpr XrSpaceVelocityFlags both = XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;

Vec3 vector_of(const XrVector3f& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

OpenXrHead::OpenXrHead(XrSession session)
    : head_(make_space(session, XR_REFERENCE_SPACE_TYPE_VIEW)), history_(remembered) {}

void OpenXrHead::sample(XrSpace world, XrTime now_runtime, Time now) {
  auto velocity = typed<XrSpaceVelocity>(XR_TYPE_SPACE_VELOCITY);
  auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  location.next = &velocity;
  check(xrLocateSpace(*head_, world, now_runtime, &location), "the OpenXR runtime does not say where the head is");
  if ((location.locationFlags & needed) != needed) return;
  // Not every runtime tells how fast the head moves.
  std::optional<Velocity> moving;
  if ((velocity.velocityFlags & both) == both)
    moving = {.angular = direction_from_graphics(vector_of(velocity.angularVelocity)),
              .linear = direction_from_graphics(vector_of(velocity.linearVelocity)) / metres_per_millimetre};
  history_.add(now, pose_of(location.pose), moving);
}

}  // namespace onestroke
