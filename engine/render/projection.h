#pragma once

#include "render/view.h"
#include "shaders/shared.h"

#include <glm/mat4x4.hpp>

namespace onestroke {

/// Graphics view space to Vulkan's clip space (y down), reverse depth without a far end: 1 at the near plane, 0 at
/// infinity. Clip w is the depth in metres.
glm::mat4 projection_of(const Fov& fov, float near_metres);

/// The plane at right angles to the camera's axis, `distance` mm in front of it, as seen from a view: takes a view ray
/// (x, y, 1) to the camera's (x, y, 1) up to a positive factor. The third value is <= 0 where the ray misses the plane;
/// all rows are zero where the view stands beyond the plane.
Mat3 plane_homography(const Pose& T_camera_view, double distance);

/// The largest squared radius (normalised coordinates) up to which the lens model is monotonic; a view ray beyond it
/// would fold back into the picture.
double distortion_limit(const Intrinsics& intrinsics);

/// Writes ray, viewport and the matrices: what a view needs where there is no picture.
void fill_view(gpu::ViewData& data, const View& view);

/// Writes the part of `data` that places the picture.
void fill_picture(gpu::ViewData& data, const View& view, const Intrinsics& intrinsics, int width, int height,
                  const Pose& T_world_camera, double distance);

}  // namespace onestroke
