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

TEST(Projection, PutsAPointOfTheCameraWhereItIsInTheWorld) {
  const View view{.T_world_view = {exp_so3({0.2, 0.1, -0.3}), {10, 20, 30}},
                  .fov = fov_of(camera, width, height),
                  .viewport = {100, 50, width, height}};
  const Pose T_world_camera{exp_so3({-0.1, 0.15, 0.05}), {60, -40, 25}};
  const gpu::ViewData data = view_data(view, T_world_camera);
  for (const Vec3 p : {Vec3{0, 0, 450}, Vec3{-70, 90, 420}, Vec3{150, 20, 900}}) {
    const glm::vec4 from_world = data.clip_from_world * glm::vec4(point_to_graphics(T_world_camera * p), 1.0F);
    const glm::vec4 from_camera = data.clip_from_camera * glm::vec4(p.x / 1000, p.y / 1000, p.z / 1000, 1.0F);
    for (glm::length_t i = 0; i < 4; ++i) EXPECT_NEAR(from_world[i], from_camera[i], 1e-6);
  }
  EXPECT_EQ(data.viewport, glm::vec4(100, 50, width, height));
}

}  // namespace
}  // namespace onestroke
