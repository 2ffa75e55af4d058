#include "scene/anchor.h"

#include "core/error.h"
#include "scene/frames.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

/// Metres.
Model box(std::array<float, 3> lower, std::array<float, 3> upper) {
  Model m;
  m.name = "box";
  m.lower = lower;
  m.upper = upper;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back({{i & 1 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1], i & 4 ? upper[2] : lower[2]},
                          {0, 0, 1},
                          {1, 0, 0, 1},
                          {},
                          {1, 1, 1, 1}});
  return m;
}

Vec3 in_marker(const Placement& p, float x, float y, float z) {
  return point_from_graphics(glm::vec3(p.marker_graphics_from_model * glm::vec4(x, y, z, 1)));
}

void expect_at(Vec3 p, Vec3 q) {
  EXPECT_NEAR(norm(p - q), 0, 1e-3) << p.x << ", " << p.y << ", " << p.z;
}

TEST(Anchor, AModelStandsJustAboveTheArmAndItsPivotIsItsMiddle) {
  const Placement cube = place_on_marker(box({-1, -1, -1}, {1, 1, 1}), 60);
  expect_at(in_marker(cube, 0, -1, 0), {38, -4, 0});
  expect_at(in_marker(cube, 0, 0, 0), cube.pivot);
  expect_at(cube.pivot, {38, -34, 0});
  const Placement slab = place_on_marker(box({0, 0, 0}, {0.05F, 0.01F, 0.02F}));
  expect_at(slab.pivot, {38, -9, 0});
  expect_at(in_marker(slab, 0.025F, 0.005F, 0.01F), slab.pivot);
}

TEST(Anchor, AModelHasItsTrueSizeUnlessItIsToFit) {
  const Model model = box({0, 0, 0}, {0.1F, 0.02F, 0.05F});
  const Placement real = place_on_marker(model);
  EXPECT_NEAR(norm(in_marker(real, 0.1F, 0, 0) - in_marker(real, 0, 0, 0)), 100, 1e-3);
  const Placement fitted = place_on_marker(model, 30);
  EXPECT_NEAR(norm(in_marker(fitted, 0.1F, 0, 0) - in_marker(fitted, 0, 0, 0)), 30, 1e-3);
  EXPECT_NEAR(norm(in_marker(fitted, 0, 0.02F, 0) - in_marker(fitted, 0, 0, 0)), 6, 1e-3);
}

TEST(Anchor, AtRotationZeroTheModelIsUprightAndSeenFromTheFront) {
  const Placement p = place_on_marker(box({0, 0, 0}, {1, 1, 1}), 60);
  const Vec3 origin = in_marker(p, 0, 0, 0);
  const Vec3 right = in_marker(p, 1, 0, 0) - origin, up = in_marker(p, 0, 1, 0) - origin,
             front = in_marker(p, 0, 0, 1) - origin;
  // The image's axes: x right, y down, z away from the camera.
  expect_at(right, {60, 0, 0});
  expect_at(up, {0, -60, 0});
  expect_at(front, {0, 0, -60});
  EXPECT_GT(glm::determinant(glm::mat3(p.marker_graphics_from_model)), 0);
}

TEST(Anchor, TheModelKeepsClearOfBothArms) {
  for (const double fit : {20.0, 60.0, 300.0}) {
    const Placement p = place_on_marker(box({-3, 2, 7}, {3, 8, 9}), fit);
    EXPECT_GT(in_marker(p, -3, 2, 7).x, 3) << fit;
    EXPECT_LT(in_marker(p, -3, 2, 7).y, -3) << fit;
  }
}

TEST(Anchor, TheReachIsThatOfTheFarthestCorner) {
  const Placement p = place_on_marker(box({0, 0, 0}, {0.06F, 0.03F, 0.02F}));
  EXPECT_NEAR(p.reach, std::sqrt(30.0 * 30 + 15 * 15 + 10 * 10), 1e-3);
}

TEST(Anchor, AModelWithoutSizeIsAnError) {
  EXPECT_THROW(place_on_marker(box({1, 1, 1}, {1, 1, 1})), Error);
}

}  // namespace
}  // namespace onestroke
