#include "display/openxr_spaces.h"

#include "display/recentring.h"
#include "scene/frames.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace onestroke {

namespace {

Quat quat_of(const XrQuaternionf& q) {
  return {q.w, q.x, q.y, q.z};
}
XrVector3f xr_vector(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Null where the runtime has none.
XrSpace make_stage(XrSession session) {
  constexpr const char* doing = "the OpenXR runtime does not say what it follows the head in: update it";
  std::uint32_t count = 0;
  check(xrEnumerateReferenceSpaces(session, 0, &count, nullptr), doing);
  std::vector<XrReferenceSpaceType> kinds(count);
  check(xrEnumerateReferenceSpaces(session, count, &count, kinds.data()), doing);
  const bool offered = std::ranges::find(kinds, XR_REFERENCE_SPACE_TYPE_STAGE) != kinds.end();
  return offered ? make_space(session, XR_REFERENCE_SPACE_TYPE_STAGE) : XR_NULL_HANDLE;
}

}  // namespace

XrSpace make_space(XrSession session, XrReferenceSpaceType kind) {
  auto info = typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
  info.referenceSpaceType = kind;
  info.poseInReferenceSpace.orientation.w = 1;
  XrSpace space = XR_NULL_HANDLE;
  check(xrCreateReferenceSpace(session, &info, &space), "the OpenXR runtime does not follow the head: restart it");
  return space;
}

Vec3 vector_of(const XrVector3f& v) {
  return {v.x, v.y, v.z};
}

Pose pose_of(const XrPosef& pose) {
  return from_graphics(quat_of(pose.orientation), vector_of(pose.position));
}

OpenXrSpaces::OpenXrSpaces(XrSession session)
    : session_(session),
      local_(make_space(session, XR_REFERENCE_SPACE_TYPE_LOCAL)),
      stage_(make_stage(session)),
      place_{*local_, {}} {
  eyes_.fill(typed<XrView>(XR_TYPE_VIEW));
}

bool OpenXrSpaces::move(const XrEventDataReferenceSpaceChangePending& change) {
  if (change.referenceSpaceType != kind_) return true;
  if (!change.poseValid) return false;
  place_.world.move(change.changeTime, pose_of(change.poseInPreviousSpace));
  return moved_ = true;
}

bool OpenXrSpaces::locate(XrTime time) {
  if (!locate_in_space(time)) return false;
  if (!settled_ && settle_in_stage(time) && !locate_in_space(time)) return false;
  settled_ = true;
  time_ = time;
  return true;
}

bool OpenXrSpaces::settle_in_stage(XrTime time) {
  if (*stage_ == XR_NULL_HANDLE) return false;
  auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
  check(xrLocateSpace(*local_, *stage_, time, &location), "the OpenXR runtime does not say where its spaces are");
  constexpr auto both = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  if ((location.locationFlags & both) != both) return false;
  place_.world.place(place_.world.T_world_space(time) * inverse(pose_of(location.pose)));
  place_.space = *stage_;
  kind_ = XR_REFERENCE_SPACE_TYPE_STAGE;
  return moved_ = true;
}

bool OpenXrSpaces::locate_in_space(XrTime time) {
  auto info = typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
  info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  info.displayTime = time;
  info.space = place_.space;
  auto state = typed<XrViewState>(XR_TYPE_VIEW_STATE);
  std::uint32_t count = 0;
  check(xrLocateViews(session_, &info, &state, static_cast<std::uint32_t>(eyes_.size()), &count, eyes_.data()),
        "the OpenXR runtime does not say where the eyes are");
  if (!(state.viewStateFlags & XR_VIEW_STATE_ORIENTATION_VALID_BIT)) return false;
  if (!(state.viewStateFlags & XR_VIEW_STATE_POSITION_VALID_BIT)) {
    const Vec3 aside = rotate(quat_of(eyes_[1].pose.orientation), right_eye_m_);
    eyes_[0].pose.position = xr_vector(head_m_ - aside);
    eyes_[1].pose.position = xr_vector(head_m_ + aside);
  } else {
    keep_place();
  }
  time_ = time;
  return true;
}

// Both eyes look the way the head does, but for what they are canted.
Pose OpenXrSpaces::recentre() {
  if (time_ == 0) return {};
  const Pose left = view(0).T_world_view, right = view(1).T_world_view;
  const Quat head = exp_so3(0.5 * log_so3(right.rotation * left.rotation.conjugate())) * left.rotation;
  const Pose T_old_new = upright({head, 0.5 * (left.translation + right.translation)});
  place_.world.place(inverse(T_old_new) * place_.world.T_world_space(time_));
  moved_ = true;
  return inverse(T_old_new);
}

void OpenXrSpaces::keep_place() {
  const Vec3 left = vector_of(eyes_[0].pose.position), right = vector_of(eyes_[1].pose.position);
  head_m_ = (left + right) / 2;
  right_eye_m_ = rotate(quat_of(eyes_[1].pose.orientation).conjugate(), (right - left) / 2);
}

View OpenXrSpaces::view(std::size_t i) const {
  const XrView& eye = eyes_.at(i);
  return {.T_world_view = place_.world.T_world_space(time_) * pose_of(eye.pose),
          .fov = {.left = std::tan(double{eye.fov.angleLeft}),
                  .right = std::tan(double{eye.fov.angleRight}),
                  .up = std::tan(double{eye.fov.angleUp}),
                  .down = std::tan(double{eye.fov.angleDown})}};
}

}  // namespace onestroke
