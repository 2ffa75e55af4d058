#pragma once

#include "camera/synthetic_options.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "marker/catalog.h"

#include <memory>
#include <optional>

namespace onestroke {

/// One synthetic camera of several that see the same.
struct SyntheticRig {
  Pose T_first_camera{};  ///< Where it sits as the first one sees it. Where a head sees, its mount alone says where.
  Time live_since;        ///< When a live one's script begins, on the clock; at its first picture where that is 0.
};

/// The camera that draws its own pictures. intrinsics: a calibration to draw with, or the pinhole camera of
/// options.fov_deg. mount: whose head sees, in place of the script's own; it outlives the camera. The catalogue is
/// copied from. Throws Error where it has too few markers or lacks the ids.
std::unique_ptr<Camera> make_synthetic_camera(const SyntheticOptions& options, const Catalog& catalog,
                                              const std::optional<Intrinsics>& intrinsics = std::nullopt,
                                              const HeadMount& mount = {}, const SyntheticRig& rig = {});

}  // namespace onestroke
