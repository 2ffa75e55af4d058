#pragma once

#include "camera/lens_source.h"
#include "core/pose.h"

#include <array>
#include <filesystem>
#include <optional>

namespace onestroke {

/// How two cameras sit beside each other, and their lenses where they are known: the left one is the first.
struct Rig {
  Pose T_first_second;
  std::optional<std::array<LensSource, 2>> lenses{};
};

/// Reads what OpenCV's cv::stereoCalibrate found, in its YAML: R and T, a point of the second camera being
/// x2 = R x1 + T, T in millimetres (the unit of the board's squares when it was calibrated); M1, D1, M2 and D2, or
/// cameraMatrix1, distCoeffs1 and so on, and where there are image_width and image_height. Where the file has R and T
/// alone, as the extrinsics.yml of OpenCV's sample stereo_calib has, the lenses are those of an intrinsics.yml beside
/// it. A lens of the rational model is taken as the polynomial nearest to it. Throws Error that names the file.
Rig read_rig(const std::filesystem::path& file);

/// Two cameras that look the same way, the second baseline_mm to the right of the first.
Rig parallel_rig(double baseline_mm);

}  // namespace onestroke
