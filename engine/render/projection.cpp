#include "render/projection.h"

#include "scene/frames.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace onestroke {

namespace {

constexpr float near_metres = static_cast<float>(near_plane * metres_per_millimetre);

}  // namespace

Fov fov_of(const Intrinsics& k, int width, int height) {
  return {-k.cx / k.fx, (width - k.cx) / k.fx, k.cy / k.fy, -(height - k.cy) / k.fy};
}

Fov fov_to_fit(const Intrinsics& k, int width, int height, const Viewport& viewport) {
  Fov fov = fov_of(k, width, height);
  const double across = fov.right - fov.left, down = fov.up - fov.down;
  const double scale = std::max(across / viewport.width, down / viewport.height);
  const double more_x = (scale * viewport.width - across) / 2, more_y = (scale * viewport.height - down) / 2;
  return {fov.left - more_x, fov.right + more_x, fov.up + more_y, fov.down - more_y};
}

glm::mat4 projection_of(const Fov& fov, float near) {
  const double across = fov.right - fov.left, down = fov.up - fov.down;
  glm::mat4 m(0.0F);
  m[0][0] = static_cast<float>(2 / across);
  m[1][1] = static_cast<float>(-2 / down);
  m[2][0] = static_cast<float>((fov.right + fov.left) / across);
  m[2][1] = static_cast<float>(-(fov.up + fov.down) / down);
  m[2][3] = -1.0F;
  m[3][2] = near;
  return m;
}

gpu::ViewData view_data(const View& view, const Pose& T_world_camera) {
  // The camera's vision axes are turned to graphics axes, in which the view looks on.
  const glm::mat4 graphics_from_vision = glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, -1.0F, -1.0F));
  const glm::mat4 projection = projection_of(view.fov, near_metres);
  const Pose T_view_world = inverse(view.T_world_view);
  const Viewport& v = view.viewport;
  return {.clip_from_world = projection * to_graphics(T_view_world),
          .clip_from_camera = projection * to_graphics(T_view_world * T_world_camera) * graphics_from_vision,
          .eye = glm::vec4(point_to_graphics(view.T_world_view.translation), 1.0F),
          .viewport = glm::vec4(v.x, v.y, v.width, v.height),
          .picture = glm::vec4(0.0F)};
}

}  // namespace onestroke
