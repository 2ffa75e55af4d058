#pragma once

#include "core/pose.h"
#include "display/held_world.h"
#include "display/openxr_api.h"
#include "render/view.h"

#include <array>
#include <span>

namespace onestroke {

/// A space of the runtime's own, its origin as it is. Throws OpenXrError.
XrSpace make_space(XrSession session, XrReferenceSpaceType kind);

/// A pose of OpenXR's in vision axes and mm.
Pose pose_of(const XrPosef& pose);

/// Where the eyes are in the world, which is the runtime's LOCAL space, its origin near where the head was at the start
/// and upright, until it is moved to where the head is.
class OpenXrSpaces {
 public:
  /// The session outlives this. Throws OpenXrError.
  explicit OpenXrSpaces(XrSession session);

  /// What poses are asked for in, and layers given in, and where that is in the world.
  XrSpace space() const { return *local_; }
  const Pose& T_world_space(XrTime time) const { return world_.T_world_space(time); }
  /// The world's origin is where the head was found last, upright and looking ahead.
  void recentre();

  /// The eyes at a time, as the runtime predicts them; false where it does not know which way the head looks. Where it
  /// loses sight of where the head is, the head stays and turns. Throws OpenXrError.
  bool locate(XrTime time);
  /// What locate() found last: as the runtime has it in space(), for its layers, and as a view in the world.
  const XrView& eye(std::size_t i) const { return eyes_.at(i); }
  View view(std::size_t i) const;

 private:
  void keep_place();

  XrSession session_;
  OpenXrOwned<XrSpace, xrDestroySpace> local_;
  HeldWorld world_;
  XrTime time_ = 0;
  std::array<XrView, max_views> eyes_;
  // Where the head was seen last, metres, and the right eye's place from there in axes of its own.
  Vec3 head_m_, right_eye_m_{0.0315, 0, 0};
};

}  // namespace onestroke
