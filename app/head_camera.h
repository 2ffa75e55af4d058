#pragma once

#include "core/camera_wrapper.h"
#include "core/head_tracker.h"

#include <memory>

namespace onestroke {

/// A camera on the wearer's head: its pictures say where in the world they were taken, by where the head was in the
/// middle of their exposure. Where that is not known they stay where the last one was.
class HeadCamera final : public CameraWrapper {
 public:
  /// The head outlives this.
  HeadCamera(std::unique_ptr<Camera> camera, const HeadMount& mount)
      : CameraWrapper(std::move(camera)), mount_(mount), T_world_camera_(mount.T_head_camera) {}

  Status next(PictureHandle& picture) override;

 private:
  const HeadMount mount_;
  Pose T_world_camera_;
};

}  // namespace onestroke
