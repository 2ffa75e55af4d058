#pragma once

#include "camera/lens_source.h"
#include "camera/pair_pool.h"
#include "core/camera_wrapper.h"

#include <array>
#include <memory>
#include <string>

namespace onestroke {

/// A camera whose pictures hold those of two eyes beside each other, the left one on the left: each half becomes a
/// picture of its own, the right one the second of the left. No byte is copied. A half has no JPEG of its own, even
/// where the whole has one.
class SideBySideCamera final : public CameraWrapper {
 public:
  /// lenses: of the halves. T_first_second is where the right eye is as the left one sees it.
  SideBySideCamera(std::unique_ptr<Camera> camera, const std::array<LensSource, 2>& lenses, const Pose& T_first_second);

  Status next(PictureHandle& picture) override;
  std::string message() const override { return message_.empty() ? CameraWrapper::message() : message_; }

 private:
  bool fits(const Picture& whole);

  const std::array<LensSource, 2> lenses_;
  const Pose T_first_second_;
  PairPool pairs_;
  int width_ = 0, height_ = 0;  // of the wholes that intrinsics_ are for
  std::array<Intrinsics, 2> intrinsics_;
  std::string message_;
};

}  // namespace onestroke
