#include "render/projection.h"

#include "scene/frames.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

const Intrinsics camera{.fx = 800, .fy = 820, .cx = 310, .cy = 250, .distortion = {}};
constexpr int width = 640, height = 480;

/// Pixel where a point (vision axes of the view, mm) lands through the graphics pipeline's matrices.
glm::vec2 pixel_through_clip(const Fov& fov, Vec3 p) {
  const glm::vec4 clip = projection_of(fov, 0.02F) * glm::vec4(point_to_graphics(p), 1.0F);
  return {(clip.x / clip.w + 1) / 2 * width, (clip.y / clip.w + 1) / 2 * height};
}

TEST(Projection, PutsPointsWhereThePinholeDoes) {
  const Fov fov = fov_of(camera, width, height);
  for (const Vec3 p : {Vec3{0, 0, 500}, Vec3{120, -80, 400}, Vec3{-200, 150, 900}}) {
    const glm::vec2 at = pixel_through_clip(fov, p);
    EXPECT_NEAR(at.x, camera.fx * p.x / p.z + camera.cx, 1e-3);
    EXPECT_NEAR(at.y, camera.fy * p.y / p.z + camera.cy, 1e-3);
  }
}

TEST(Projection, ReversesDepthWithoutAFarEnd) {
  const glm::mat4 m = projection_of({}, 0.02F);
  const auto depth = [&m](float metres) {
    const glm::vec4 clip = m * glm::vec4(0, 0, -metres, 1);
    EXPECT_FLOAT_EQ(clip.w, metres);
    return clip.z / clip.w;
  };
  EXPECT_FLOAT_EQ(depth(0.02F), 1.0F);
  EXPECT_GT(depth(0.3F), depth(0.300001F));
  EXPECT_GT(depth(1e6F), 0.0F);
  EXPECT_LT(depth(1e6F), 1e-6F);
}

TEST(Projection, FitsThePictureIntoAnotherShape) {
  const Fov own = fov_of(camera, width, height);
  const Fov wide = fov_to_fit(camera, width, height, {0, 0, 1280, 480});
  EXPECT_NEAR(wide.up, own.up, 1e-12);
  EXPECT_NEAR(wide.down, own.down, 1e-12);
  EXPECT_NEAR(wide.left + wide.right, own.left + own.right, 1e-12);
  // One tangent takes as many pixels across as down.
  EXPECT_NEAR((wide.right - wide.left) / 1280, (wide.up - wide.down) / 480, 1e-12);
  const Fov tall = fov_to_fit(camera, width, height, {0, 0, 320, 480});
  EXPECT_NEAR(tall.right - tall.left, own.right - own.left, 1e-12);
  EXPECT_GT(tall.up - tall.down, own.up - own.down);
}

TEST(Projection, SeesThePlaneAsTheCameraDoes) {
  const Pose T_camera_view{exp_so3({0.1, -0.3, 0.2}), {60, -40, 25}};
  constexpr double distance = 450;
  const Mat3 h = plane_homography(T_camera_view, distance);
  for (const Vec3 on_plane : {Vec3{0, 0, distance}, Vec3{-90, 70, distance}, Vec3{150, 20, distance}}) {
    const Vec3 v = inverse(T_camera_view) * on_plane;
    const Vec3 ray{v.x / v.z, v.y / v.z, 1};
    const auto row = [&](std::size_t i) { return h[i][0] * ray.x + h[i][1] * ray.y + h[i][2] * ray.z; };
    EXPECT_GT(row(2), 0);
    EXPECT_NEAR(row(0) / row(2), on_plane.x / distance, 1e-12);
    EXPECT_NEAR(row(1) / row(2), on_plane.y / distance, 1e-12);
  }
}

TEST(Projection, IsTheIdentityFromTheCamera) {
  const Mat3 h = plane_homography({}, 450);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) EXPECT_DOUBLE_EQ(h[i][j], i == j ? 1.0 : 0.0);
}

TEST(Projection, SeesNothingOfThePlaneFromBeyondIt) {
  EXPECT_EQ(plane_homography({{}, {0, 0, 500}}, 450), Mat3{});
}

TEST(Projection, LimitsTheLensToWhereItDoesNotFold) {
  EXPECT_GE(distortion_limit(camera), 99);
  Intrinsics barrel = camera;
  barrel.distortion = {-0.3, 0, 0, 0, 0};
  // r (1 - 0.3 r^2) turns back where r^2 = 1 / 0.9.
  EXPECT_NEAR(distortion_limit(barrel), 1 / 0.9, 0.051);
  EXPECT_LE(distortion_limit(barrel), 1 / 0.9);
}

TEST(Projection, LooksAlongTheRayOfEveryPixel) {
  View view{.T_world_view = {exp_so3({0.2, 0.1, -0.3}), {10, 20, 30}},
            .fov = fov_of(camera, width, height),
            .viewport = {100, 50, width, height}};
  gpu::ViewData data{};
  fill_view(data, view);
  const Vec3 in_view{-70, 90, 420};
  const glm::vec4 clip = data.clip_from_world * glm::vec4(point_to_graphics(view.T_world_view * in_view), 1.0F);
  const double px = (double{clip.x} / double{clip.w} + 1) / 2 * width,
               py = (double{clip.y} / double{clip.w} + 1) / 2 * height;
  EXPECT_NEAR(px * double{data.ray.x} + double{data.ray.z}, in_view.x / in_view.z, 1e-5);
  EXPECT_NEAR(py * double{data.ray.y} + double{data.ray.w}, in_view.y / in_view.z, 1e-5);
}

}  // namespace
}  // namespace onestroke
