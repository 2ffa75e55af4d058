#pragma once

#include "camera/lens_source.h"
#include "camera/live_options.h"
#include "camera/synthetic_camera.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "marker/catalog.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace onestroke {

/// Which pictures to take and what is known of the camera that takes them.
struct CameraOptions {
  /// `synthetic[:key=value,...]`, `libcamera[:NAME]`, `folder:DIR` or `file:VIDEO`.
  std::string spec = "synthetic";
  std::optional<double> fov_rad;      ///< Horizontal field of view of an ideal lens.
  std::filesystem::path calibration;  ///< OpenCV's YAML; overrides fov_rad. Empty for none.
  Duration readout;                   ///< First row to last row, top first; 0 for a global shutter.
  const Catalog* catalog = nullptr;   ///< The markers that the synthetic camera shows; read while opening only.
  LiveOptions live{};                 ///< For `libcamera` alone.
  HeadMount mount{};                  ///< Whose head the synthetic camera sees from; outlives the camera.
  std::optional<LensSource> lens{};   ///< What is known of the lens already; in place of fov_rad and calibration.
  SyntheticRig rig{};                 ///< Where the synthetic camera sits among others.
};

/// Opens a camera. Folders, videos and live cameras need a field of view or a calibration; the synthetic camera brings
/// its own. Throws Error, or UsageError where the spec itself is wrong.
std::unique_ptr<Camera> open_camera(const CameraOptions& options);

}  // namespace onestroke
