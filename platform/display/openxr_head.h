#pragma once

#include "core/pose_history.h"
#include "display/openxr_api.h"

namespace onestroke {

/// Where the head was of late.
class OpenXrHead {
 public:
  /// The session outlives this. Throws OpenXrError.
  explicit OpenXrHead(XrSession session);

  /// Asks where the head is in `world` now, and remembers it where the runtime knows. Throws OpenXrError.
  void sample(XrSpace world, XrTime now_runtime, Time now);
  /// The world has moved: what was remembered holds no more.
  void forget() { history_.clear(); }
  const PoseHistory& history() const { return history_; }

 private:
  OpenXrOwned<XrSpace, xrDestroySpace> head_;
  PoseHistory history_;
};

}  // namespace onestroke
