#pragma once

#include "core/pose.h"
#include "display/held_world.h"
#include "display/openxr_api.h"
#include "render/view.h"

#include <array>
#include <utility>

namespace onestroke {

/// A space of the runtime's, and where that is in the world.
struct OpenXrPlace {
  XrSpace space = XR_NULL_HANDLE;
  HeldWorld world;
};

/// A space of the runtime's own, its origin as it is. Throws OpenXrError.
XrSpace make_space(XrSession session, XrReferenceSpaceType kind);

/// A vector of OpenXR's as it is: graphics axes, metres.
Vec3 vector_of(const XrVector3f& v);

/// A pose of OpenXR's in vision axes and mm.
Pose pose_of(const XrPosef& pose);

/// Where the eyes are in the world, which is the runtime's LOCAL space as it was when the eyes were first seen: its
/// origin near where the head was, and upright. Recentring does not move it, as it does not move what is in the room:
/// it is asked for in STAGE, which stays, where the runtime has that, and otherwise in LOCAL as the runtime says that
/// it moves. Only
/// recentre() moves it.
class OpenXrSpaces {
 public:
  /// The session outlives this. Throws OpenXrError.
  explicit OpenXrSpaces(XrSession session);

  /// What poses are asked for in, and layers given in.
  const OpenXrPlace& place() const { return place_; }
  /// True once after that has become another.
  bool take_moved() { return std::exchange(moved_, false); }
  /// The runtime is about to move a space. False where the world moves with it, nobody knows how far.
  bool move(const XrEventDataReferenceSpaceChangePending& change);
  /// Moves the world's origin to where the head was found last, upright and looking ahead. T_new_old.
  Pose recentre();

  /// The eyes at a time, as the runtime predicts them; false where it does not know which way the head looks. Where it
  /// loses sight of where the head is, the head stays and turns. Throws OpenXrError.
  bool locate(XrTime time);
  /// What locate() found last: as the runtime has it in place(), for its layers, and as a view in the world.
  const XrView& eye(std::size_t i) const { return eyes_.at(i); }
  View view(std::size_t i) const;

 private:
  bool locate_in_space(XrTime time);
  void keep_place();
  bool settle_in_stage(XrTime time);

  XrSession session_;
  OpenXrOwned<XrSpace, xrDestroySpace> local_, stage_;
  XrReferenceSpaceType kind_ = XR_REFERENCE_SPACE_TYPE_LOCAL;
  bool settled_ = false, moved_ = false;
  OpenXrPlace place_;
  XrTime time_ = 0;
  std::array<XrView, max_views> eyes_;
  // Where the head was seen last, metres, and the right eye's place from there in axes of its own.
  Vec3 head_m_, right_eye_m_{0.0315, 0, 0};
};

}  // namespace onestroke
