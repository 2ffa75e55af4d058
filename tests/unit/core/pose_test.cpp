#include "core/pose.h"

#include "random_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

using std::numbers::pi;
using test::RandomPose;

constexpr int rounds = 2000;
// Angles where a formula could lose digits: around 0, around pi, and between.
constexpr double angles[] = {0,   1e-300, 1e-12, 1e-9, 9.99e-7,   1.01e-6,   1e-4,
                             0.1, 1.5,    3.0,   3.14, pi - 1e-6, pi - 1e-9, pi - 1e-12};

double matrix_distance(const Mat3& a, const Mat3& b) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) worst = std::max(worst, std::abs(a[i][j] - b[i][j]));
  return worst;
}

TEST(Vec3, CrossIsRightHandedAndPerpendicular) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Vec3 a = random.vector(10), b = random.vector(10), c = cross(a, b);
    EXPECT_NEAR(dot(a, c), 0, 1e-12 * norm(a) * norm(c) + 1e-12);
    EXPECT_NEAR(dot(c, c) + dot(a, b) * dot(a, b), dot(a, a) * dot(b, b), 1e-9);
  }
}

TEST(Vec3, NormalizingZeroGivesZero) {
  EXPECT_EQ(normalized(Vec3{}), Vec3{});
}

TEST(Rotation, ExpTurnsByTheRightHand) {
  const Vec3 turned = rotate(exp_so3({0, 0, pi / 2}), {1, 0, 0});
  EXPECT_NEAR(norm(turned - Vec3{0, 1, 0}), 0, 1e-15);
}

TEST(Rotation, ExpAndLogAreInverseFromZeroToPi) {
  RandomPose random;
  for (const double angle : angles)
    for (int i = 0; i < 200; ++i) {
      const Vec3 v = random.turn(angle);
      const Vec3 back = log_so3(exp_so3(v));
      // A double holds w = cos(angle / 2) only to 1e-16, so nothing near pi can be better than that in angle.
      EXPECT_NEAR(norm(back - v), 0, 1e-14) << angle;
      EXPECT_LE(norm(back), pi + 1e-15);
    }
}

TEST(Rotation, LogIgnoresTheSignOfTheQuaternion) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Quat q = random.rotation();
    EXPECT_NEAR(norm(log_so3(q) - log_so3({-q.w, -q.x, -q.y, -q.z})), 0, 1e-12);
  }
}

TEST(Rotation, TurnsBeyondPiComeBackTheShortWay) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Vec3 axis = random.direction();
    const double angle = random.uniform(pi, 2 * pi);
    EXPECT_NEAR(norm(log_so3(exp_so3(angle * axis)) - (angle - 2 * pi) * axis), 0, 1e-12);
  }
}

TEST(Rotation, MatrixIsARotationAndTurnsAsTheQuaternionDoes) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Quat q = random.rotation();
    const Mat3 m = to_matrix(q);
    const Vec3 x{m[0][0], m[1][0], m[2][0]}, y{m[0][1], m[1][1], m[2][1]}, z{m[0][2], m[1][2], m[2][2]};
    EXPECT_NEAR(norm(cross(x, y) - z), 0, 1e-14);
    EXPECT_NEAR(dot(x, y), 0, 1e-14);
    EXPECT_NEAR(norm(x), 1, 1e-14);
    const Vec3 v = random.vector(100);
    EXPECT_NEAR(norm(rotate(q, v) - (v.x * x + v.y * y + v.z * z)), 0, 1e-12);
  }
}

TEST(Rotation, MatrixAndQuaternionAreInverseFromZeroToPi) {
  RandomPose random;
  for (const double angle : angles)
    for (int i = 0; i < 200; ++i) {
      const Quat q = exp_so3(random.turn(angle));
      EXPECT_NEAR(angle_between(to_quat(to_matrix(q)), q), 0, 1e-14) << angle;
    }
  // Half turns about each axis, where each of the four branches must carry.
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const Quat q = exp_so3(pi * axis);
    EXPECT_NEAR(angle_between(to_quat(to_matrix(q)), q), 0, 1e-14);
  }
}

TEST(Rotation, EulerIsRxThenRyThenRz) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const double a = random.uniform(-pi, pi), b = random.uniform(-pi / 2, pi / 2), c = random.uniform(-pi, pi);
    const Vec3 v = random.vector(1);
    const Vec3 about_x{v.x, std::cos(a) * v.y - std::sin(a) * v.z, std::sin(a) * v.y + std::cos(a) * v.z};
    const Vec3 about_y{std::cos(b) * about_x.x + std::sin(b) * about_x.z, about_x.y,
                       -std::sin(b) * about_x.x + std::cos(b) * about_x.z};
    const Vec3 about_z{std::cos(c) * about_y.x - std::sin(c) * about_y.y,
                       std::sin(c) * about_y.x + std::cos(c) * about_y.y, about_y.z};
    EXPECT_NEAR(norm(rotate(from_euler_xyz(a, b, c), v) - about_z), 0, 1e-14);
  }
}

TEST(Rotation, EulerAnglesComeBack) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Vec3 e{random.uniform(-3.1, 3.1), random.uniform(-1.5, 1.5), random.uniform(-3.1, 3.1)};
    EXPECT_NEAR(norm(to_euler_xyz(from_euler_xyz(e.x, e.y, e.z)) - e), 0, 1e-12);
  }
}

TEST(Rotation, EulerAnglesGiveTheSameRotationAlsoAtTheirSingularity) {
  RandomPose random;
  for (const double b : {pi / 2, -pi / 2, pi / 2 - 1e-7, -pi / 2 + 1e-7, pi / 2 - 1e-3})
    for (int i = 0; i < 200; ++i) {
      const Quat q = from_euler_xyz(random.uniform(-pi, pi), b, random.uniform(-pi, pi));
      const Vec3 e = to_euler_xyz(q);
      // asin loses half the digits at its end.
      EXPECT_NEAR(angle_between(from_euler_xyz(e.x, e.y, e.z), q), 0, 3e-6) << b;
    }
}

TEST(Pose, ComposesAsItsPointsDo) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Pose a = random.pose(), b = random.pose(), c = random.pose();
    const Vec3 p = random.vector(500);
    EXPECT_NEAR(norm((a * b) * p - a * (b * p)), 0, 1e-9);
    EXPECT_NEAR(norm(((a * b) * c) * p - (a * (b * c)) * p), 0, 1e-9);
  }
}

TEST(Pose, InverseUndoesFromBothSides) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Pose a = random.pose();
    for (const Pose& unit : {a * inverse(a), inverse(a) * a}) {
      EXPECT_NEAR(norm(unit.translation), 0, 1e-9);
      EXPECT_NEAR(angle_between(unit.rotation, {}), 0, 1e-14);
    }
  }
}

TEST(Pose, LongChainsStayRigid) {
  RandomPose random;
  Pose chain;
  for (int i = 0; i < 100000; ++i) chain = chain * Pose{random.rotation(), {}};
  const Mat3 m = to_matrix(chain.rotation);
  EXPECT_LT(matrix_distance(to_matrix(to_quat(m)), m), 1e-14);
  EXPECT_NEAR(norm(rotate(chain.rotation, {1, 0, 0})), 1, 1e-14);
}

TEST(Pose, InterpolationMeetsItsEndsAndMovesEvenly) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Pose a = random.pose(), b = random.pose();
    EXPECT_NEAR(angle_between(interpolate(a, b, 0).rotation, a.rotation), 0, 1e-13);
    EXPECT_NEAR(angle_between(interpolate(a, b, 1).rotation, b.rotation), 0, 1e-13);
    EXPECT_NEAR(norm(interpolate(a, b, 1).translation - b.translation), 0, 1e-12);
    const double u = random.uniform(0, 1), whole = angle_between(a.rotation, b.rotation);
    EXPECT_NEAR(angle_between(interpolate(a, b, u).rotation, a.rotation), u * whole, 1e-12);
  }
}

TEST(Pose, ExtrapolationUndoesInterpolation) {
  RandomPose random;
  for (int i = 0; i < rounds; ++i) {
    const Pose a = random.pose(), b = {random.rotation(), {}};
    const Pose half = interpolate(a, b, 0.5);
    EXPECT_NEAR(angle_between(interpolate(a, half, 2).rotation, b.rotation), 0, 1e-12);
    EXPECT_NEAR(norm(interpolate(a, half, 2).translation - b.translation), 0, 1e-9);
  }
}

}  // namespace
}  // namespace onestroke
