#include "scene/anchor.h"

#include "core/error.h"
#include "scene/frames.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace onestroke {
namespace {

Model box(std::array<float, 3> lower, std::array<float, 3> upper) {
  Model m;
  m.name = "box";
  m.lower = lower;
  m.upper = upper;
  return m;
}

Vec3 in_marker(const glm::mat4& m, float x, float y, float z) {
  return point_from_graphics(glm::vec3(m * glm::vec4(x, y, z, 1)));
}

void expect_at(Vec3 p, Vec3 q) {
  EXPECT_NEAR(norm(p - q), 0, 1e-3) << p.x << ", " << p.y << ", " << p.z;
}

TEST(Anchor, ACubeIsCentredOnThePivotAndStandsJustAboveTheArm) {
  const glm::mat4 m = marker_graphics_from_model(box({-1, -1, -1}, {1, 1, 1}));
  expect_at(in_marker(m, 0, 0, 0), anchor_pivot);
  expect_at(in_marker(m, 0, -1, 0), {38, -4, 0});
}

TEST(Anchor, TheLongestSideDecidesTheSize) {
  const glm::mat4 m = marker_graphics_from_model(box({0, 0, 0}, {0.1F, 0.02F, 0.05F}));
  EXPECT_NEAR(norm(in_marker(m, 0.1F, 0, 0) - in_marker(m, 0, 0, 0)), 60, 1e-3);
  EXPECT_NEAR(norm(in_marker(m, 0, 0.02F, 0) - in_marker(m, 0, 0, 0)), 12, 1e-3);
  const glm::mat4 small = marker_graphics_from_model(box({0, 0, 0}, {0.1F, 0.02F, 0.05F}), {{38, -4, 0}, 30});
  EXPECT_NEAR(norm(in_marker(small, 0.1F, 0, 0) - in_marker(small, 0, 0, 0)), 30, 1e-3);
}

TEST(Anchor, AtRotationZeroTheModelIsUprightAndSeenFromTheFront) {
  const glm::mat4 m = marker_graphics_from_model(box({0, 0, 0}, {1, 1, 1}));
  const Vec3 origin = in_marker(m, 0, 0, 0);
  const Vec3 right = in_marker(m, 1, 0, 0) - origin, up = in_marker(m, 0, 1, 0) - origin,
             front = in_marker(m, 0, 0, 1) - origin;
  // The image's axes: x right, y down, z away from the camera.
  expect_at(right, {60, 0, 0});
  expect_at(up, {0, -60, 0});
  expect_at(front, {0, 0, -60});
  EXPECT_GT(glm::determinant(glm::mat3(m)), 0);
}

TEST(Anchor, TheModelKeepsClearOfBothArms) {
  const glm::mat4 m = marker_graphics_from_model(box({-3, 2, 7}, {3, 8, 9}));
  EXPECT_GT(in_marker(m, -3, 2, 7).x, 3);
  EXPECT_LT(in_marker(m, -3, 2, 7).y, -3);
}

TEST(Anchor, AModelWithoutSizeIsAnError) {
  EXPECT_THROW(marker_graphics_from_model(box({1, 1, 1}, {1, 1, 1})), Error);
}

}  // namespace
}  // namespace onestroke
