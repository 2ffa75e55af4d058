#pragma once

#include "core/camera.h"

#include <memory>
#include <utility>

namespace onestroke {

/// A camera whose pictures are another one's, changed: whatever else it is asked the other one answers.
class CameraWrapper : public Camera {
 public:
  std::string message() const override { return camera_->message(); }
  bool live() const override { return camera_->live(); }
  double rate() const override { return camera_->rate(); }
  std::size_t length() const override { return camera_->length(); }
  double period() const override { return camera_->period(); }
  std::string_view trouble() const override { return camera_->trouble(); }
  std::uint64_t lost() const override { return camera_->lost(); }
  bool seek(Duration after_start) override { return camera_->seek(after_start); }
  Time began() const override { return camera_->began(); }
  std::span<const TrueMarker> truth(const Picture& picture) const override { return camera_->truth(picture); }

 protected:
  explicit CameraWrapper(std::unique_ptr<Camera> camera) : camera_(std::move(camera)) {}

  Camera& wrapped() { return *camera_; }

 private:
  const std::unique_ptr<Camera> camera_;
};

}  // namespace onestroke
