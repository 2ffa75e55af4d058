#include "scene/frames.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <numbers>

namespace onestroke {
namespace {

constexpr double pi = std::numbers::pi;

void expect_near(const glm::mat4& a, const glm::mat4& b, float tolerance) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance) << "column " << c << ", row " << r;
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "coordinate " << i;
}

const Pose a{from_euler_xyz(0.3, -1.1, 2.0), {120, -45, 480}};
const Pose b{from_euler_xyz(-2.2, 0.4, 0.7), {-30, 8, 65}};

TEST(Frames, IdentityStaysIdentity) {
  expect_near(to_graphics(Pose{}), glm::mat4(1.0F), 0);
}

TEST(Frames, MatricesComposeAsPosesDo) {
  expect_near(to_graphics(a * b), to_graphics(a) * to_graphics(b), 1e-6F);
  expect_near(to_graphics(inverse(a)), glm::inverse(to_graphics(a)), 1e-6F);
}

TEST(Frames, MovingAPointAndThenChangingAxesIsTheSameAsTheOtherWayRound) {
  const Vec3 p{11, -7, 23};
  expect_near(point_to_graphics(a * p), glm::vec3(to_graphics(a) * glm::vec4(point_to_graphics(p), 1)), 1e-6F);
}

TEST(Frames, PosesComeBack) {
  const Pose back = from_graphics(to_graphics(a));
  EXPECT_NEAR(angle_between(back.rotation, a.rotation), 0, 1e-6);
  EXPECT_NEAR(norm(back.translation - a.translation), 0, 1e-4);
}

TEST(Frames, ARotationAndATranslationAreTheMatrixThatTheyMake) {
  const glm::mat4 m = to_graphics(a);
  const Quat q = to_quat(Mat3{{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}});
  const Pose back = from_graphics(q, {m[3][0], m[3][1], m[3][2]});
  EXPECT_NEAR(angle_between(back.rotation, a.rotation), 0, 1e-6);
  EXPECT_NEAR(norm(back.translation - a.translation), 0, 1e-4);
}

TEST(Frames, PointsComeBack) {
  const Vec3 p{12.5, -300, 700};
  EXPECT_NEAR(norm(point_from_graphics(point_to_graphics(p)) - p), 0, 1e-4);
  EXPECT_NEAR(norm(direction_from_graphics(direction_to_graphics(p)) - p), 0, 1e-4);
}

TEST(Frames, HandednessIsKept) {
  EXPECT_NEAR(glm::determinant(glm::mat3(to_graphics(a))), 1, 1e-6F);
  const glm::vec3 x = direction_to_graphics({1, 0, 0}), y = direction_to_graphics({0, 1, 0});
  expect_near(glm::cross(x, y), direction_to_graphics(cross({1, 0, 0}, {0, 1, 0})), 0);
}

TEST(Frames, APointBelowAndAheadIsBelowAndAheadInMetres) {
  expect_near(point_to_graphics({250, 100, 500}), {0.25F, -0.1F, -0.5F}, 1e-7F);
  expect_near(direction_to_graphics({0, 0, 1}), {0, 0, -1}, 0);
}

TEST(Frames, ATranslationIsTheConvertedPoint) {
  const glm::mat4 m = to_graphics({{}, {250, 100, 500}});
  expect_near(glm::vec3(m[3]), {0.25F, -0.1F, -0.5F}, 1e-7F);
}

TEST(Frames, AQuarterTurnOfTheImageTurnsTheSameWayInBoth) {
  // About z of vision (into the picture) the image's x axis goes to y, which is down: clockwise as seen.
  const glm::mat4 m = to_graphics({exp_so3({0, 0, pi / 2}), {}});
  expect_near(glm::vec3(m * glm::vec4(1, 0, 0, 0)), {0, -1, 0}, 1e-6F);
}

TEST(Frames, ATurnAboutXIsTheSameInBoth) {
  const glm::mat4 m = to_graphics({exp_so3({pi / 2, 0, 0}), {}});
  expect_near(glm::vec3(m * glm::vec4(0, 1, 0, 0)), {0, 0, 1}, 1e-6F);
}

}  // namespace
}  // namespace onestroke
