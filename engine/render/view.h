#pragma once

#include "core/picture.h"
#include "core/pose.h"

namespace onestroke {

/// Tangents of the angles from the optical axis to a view's edges: left and down are negative, as in OpenXR.
struct Fov {
  double left = -1, right = 1, up = 1, down = -1;
};

/// Pixels of the view's layer of the target image, from its top left corner.
struct Viewport {
  int x = 0, y = 0, width = 0, height = 0;
};

/// One eye or one window, seen from one place. Vision axes (x right, y down, z forward), millimetres.
struct View {
  Pose T_world_view{};
  Fov fov{};
  Viewport viewport{};
};

inline constexpr int max_views = 2;
/// What is nearer is not drawn, mm.
inline constexpr double near_plane = 20;

/// Pixels for each unit of a tangent.
inline double focal_length_px(const View& view) {
  return view.viewport.height / (view.fov.up - view.fov.down);
}

/// The field of view of a camera: a view with it, at the camera's pose and the picture's size, shows the picture pixel
/// for pixel (distortion apart).
Fov fov_of(const Intrinsics& intrinsics, int picture_width, int picture_height);

/// The same, widened so that the whole picture fits a viewport of another shape, undistorted and centred.
Fov fov_to_fit(const Intrinsics& intrinsics, int picture_width, int picture_height, const Viewport& viewport);

}  // namespace onestroke
