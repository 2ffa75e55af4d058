#pragma once

#include "core/camera.h"
#include "core/head_tracker.h"

namespace onestroke {

/// A camera on the wearer's head: its pictures say where in the world they were taken, by where the head was in the
/// middle of their exposure. Where that is not known they stay where the last one was.
class HeadCamera final : public Camera {
 public:
  /// Camera and head outlive this.
  HeadCamera(Camera& camera, const HeadMount& mount)
      : camera_(camera), mount_(mount), T_world_camera_(mount.T_head_camera) {}

  Status next(PictureHandle& picture) override;
  std::string message() const override { return camera_.message(); }
  bool live() const override { return camera_.live(); }
  double rate() const override { return camera_.rate(); }
  std::size_t length() const override { return camera_.length(); }
  double period() const override { return camera_.period(); }
  std::span<const TrueMarker> truth(const Picture& picture) const override { return camera_.truth(picture); }

 private:
  Camera& camera_;
  const HeadMount mount_;
  Pose T_world_camera_;
};

}  // namespace onestroke
