#pragma once

#include "core/camera.h"
#include "core/head_tracker.h"

#include <memory>

namespace onestroke {

/// A camera on the wearer's head: its pictures say where in the world they were taken, by where the head was in the
/// middle of their exposure. Where that is not known they stay where the last one was.
class HeadCamera final : public Camera {
 public:
  /// The head outlives this.
  HeadCamera(std::unique_ptr<Camera> camera, const HeadMount& mount)
      : camera_(std::move(camera)), mount_(mount), T_world_camera_(mount.T_head_camera) {}

  Status next(PictureHandle& picture) override;
  std::string message() const override { return camera_->message(); }
  bool live() const override { return camera_->live(); }
  double rate() const override { return camera_->rate(); }
  std::size_t length() const override { return camera_->length(); }
  double period() const override { return camera_->period(); }
  std::string_view trouble() const override { return camera_->trouble(); }
  std::uint64_t lost() const override { return camera_->lost(); }
  bool seek(Duration after_start) override { return camera_->seek(after_start); }
  std::span<const TrueMarker> truth(const Picture& picture) const override { return camera_->truth(picture); }

 private:
  const std::unique_ptr<Camera> camera_;
  const HeadMount mount_;
  Pose T_world_camera_;
};

}  // namespace onestroke
