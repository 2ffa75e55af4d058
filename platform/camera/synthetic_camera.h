#pragma once

#include "camera/synthetic_options.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "marker/catalog.h"

#include <memory>
#include <optional>

namespace onestroke {

/// The camera that draws its own pictures. intrinsics: a calibration to draw with, or the pinhole camera of
/// options.fov_deg. mount: whose head sees, in place of the script's own; it outlives the camera. The catalogue is
/// copied from. Throws Error where it has too few markers or lacks the ids.
std::unique_ptr<Camera> make_synthetic_camera(const SyntheticOptions& options, const Catalog& catalog,
                                              const std::optional<Intrinsics>& intrinsics = std::nullopt,
                                              const HeadMount& mount = {});

}  // namespace onestroke
