#pragma once

#include "core/picture.h"

#include <filesystem>
#include <optional>
#include <string>

namespace onestroke {

/// Where a recording's intrinsics come from: a calibration file, or else a field of view.
class LensSource {
 public:
  /// Reads the calibration (image_width, image_height, camera_matrix, distortion_coefficients), where one is named.
  /// Throws Error that names the file where it is missing or is no calibration.
  LensSource(const std::filesystem::path& calibration, std::optional<double> fov_rad);

  /// Of lenses that were read before: `file` is where they are from, for messages. Sizes of 0 where it does not say for
  /// which pictures.
  LensSource(const std::filesystem::path& file, const Intrinsics& calibrated, int width, int height)
      : file_(file), calibrated_(calibrated), width_(width), height_(height) {}

  bool known() const { return calibrated_ || fov_rad_; }
  /// For pictures of that size. Throws Error where the calibration was made for another, naming both and `pictures`,
  /// or, where it does not say for which, must have been.
  Intrinsics intrinsics(int width, int height, const std::string& pictures) const;

 private:
  std::filesystem::path file_;
  std::optional<Intrinsics> calibrated_;
  std::optional<double> fov_rad_;
  int width_ = 0, height_ = 0;
};

}  // namespace onestroke
