#include "render/projection.h"

#include "scene/frames.h"

#include <algorithm>

namespace onestroke {

namespace {

constexpr float near_metres = 0.02F;

glm::vec4 row_of(const std::array<double, 3>& row) {
  return {static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2]), 0.0F};
}

glm::vec4 vec4_of(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

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

Mat3 plane_homography(const Pose& T_camera_view, double distance) {
  const Mat3 r = to_matrix(T_camera_view.rotation);
  const Vec3 t = T_camera_view.translation;
  const double ahead = distance - t.z;
  Mat3 h{};
  if (ahead <= 0) return h;
  for (std::size_t i = 0; i < 3; ++i) {
    h[0][i] = (ahead * r[0][i] + t.x * r[2][i]) / distance;
    h[1][i] = (ahead * r[1][i] + t.y * r[2][i]) / distance;
    h[2][i] = r[2][i];
  }
  return h;
}

double distortion_limit(const Intrinsics& intrinsics) {
  const auto& d = intrinsics.distortion;
  constexpr double farthest = 100;  // r = 10, 84 degrees off the axis
  constexpr int steps = 2000;
  for (int i = 1; i <= steps; ++i) {
    const double r2 = farthest * i / steps;
    const double slope = 1 + r2 * (3 * d[0] + r2 * (5 * d[1] + r2 * 7 * d[4]));
    if (slope <= 0) return farthest * (i - 1) / steps;
  }
  return farthest;
}

void fill_view(gpu::ViewData& data, const View& view) {
  const Fov& f = view.fov;
  const Viewport& v = view.viewport;
  data.clip_from_world = projection_of(f, near_metres) * to_graphics(inverse(view.T_world_view));
  data.eye = glm::vec4(point_to_graphics(view.T_world_view.translation), 1.0F);
  data.viewport = vec4_of(v.x, v.y, v.width, v.height);
  data.ray = vec4_of((f.right - f.left) / v.width, (f.up - f.down) / v.height, f.left, -f.up);
}

void fill_picture(gpu::ViewData& data, const View& view, const Intrinsics& k, int width, int height,
                  const Pose& T_world_camera, double distance) {
  const Mat3 h = plane_homography(inverse(T_world_camera) * view.T_world_view, distance);
  for (std::size_t i = 0; i < 3; ++i) data.picture_rows[i] = row_of(h[i]);
  data.picture_intrinsic = vec4_of(k.fx / width, k.fy / height, k.cx / width, k.cy / height);
  const auto& d = k.distortion;
  data.distortion = vec4_of(d[0], d[1], d[2], d[3]);
  data.distortion_more = vec4_of(d[4], distortion_limit(k), static_cast<double>(width) / height, 0);
}

}  // namespace onestroke
