// A moving marker before a shutter that exposes its rows one after another.

#include "tracking/rolling.h"

#include "../core/random_pose.h"
#include "marker_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace onestroke::test {
namespace {

Exposure rolling_exposure() {
  Exposure e;
  e.length = Duration::from_ms(2);
  e.readout = Duration::from_ms(50);
  return e;
}

TEST(RowClock, CountsFromTheMiddleRow) {
  const RowClock clock(rolling_exposure(), 1200);
  EXPECT_TRUE(clock.rolls());
  EXPECT_NEAR(clock.at(600), 0, 1e-12);
  EXPECT_NEAR(clock.at(0.5), -0.025, 1e-9) << "the first row";
  EXPECT_NEAR(clock.at(1199.5), 0.025, 1e-9) << "the last row";
}

TEST(RowClock, AGlobalShutterHasOneTime) {
  const RowClock clock(Exposure{}, 480);
  EXPECT_FALSE(clock.rolls());
  EXPECT_EQ(clock.at(3), 0);
}

/// Some hands' motion of a marker in front of the camera.
Motion random_motion(RandomPose& random) {
  const auto vector = [&](double size) -> Vec3d { return size * to_eigen(random.direction()); };
  const Pose pose{random.rotation(), {random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(300, 600)}};
  return {to_eigen(pose), vector(5), vector(500)};
}

// Turning about a fixed axis while moving along it: the rotation by the angle, and every point on its helix.
TEST(Motion, IsAScrew) {
  RandomPose random;
  for (int i = 0; i < 20; ++i) {
    const Motion m = random_motion(random);
    const double t = random.uniform(-0.02, 0.02);
    const Eigen::AngleAxis<double> turn(t * m.angular.norm(), m.angular.normalized());
    const EigenPose later = m.at(t);
    EXPECT_LT((later.R - turn.toRotationMatrix() * m.pose.R).norm(), 1e-9);
    // A point on the axis moves along it only: c = w x v / w^2 from the origin.
    const double w2 = m.angular.squaredNorm();
    const Vec3d to_axis = m.angular.cross(m.linear) / w2, along = m.angular * m.angular.dot(m.linear) / w2;
    const Vec3d expected = m.pose.t + to_axis - turn * to_axis + t * along;
    EXPECT_LT((later.t - expected).norm(), 0.01);
  }
}

TEST(Motion, ProjectsEveryPointAtItsRowsTime) {
  RandomPose random;
  const Intrinsics k = Intrinsics::from_fov(1600, 1200, 35 * radian);
  const RowClock clock(rolling_exposure(), 1200);
  int seen = 0;
  for (int i = 0; i < 50; ++i) {
    const Motion m = random_motion(random);
    const Vec3d x = 40 * to_eigen(random.direction());
    Vec2d pixel, at_once;
    if (!project(k, clock, m, m.pose * x, pixel) || pixel.y() < 0 || pixel.y() > 1200) continue;
    ++seen;
    ASSERT_TRUE(project(k, m.at(clock.at(pixel.y())) * x, at_once));
    EXPECT_LT((pixel - at_once).norm(), 0.02);
  }
  EXPECT_GT(seen, 20);
}

TEST(Motion, AGlobalShutterSeesThePoseAlone) {
  RandomPose random;
  const Intrinsics k = Intrinsics::from_fov(640, 480, 35 * radian);
  const Motion m = random_motion(random);
  Vec2d rolling, plain;
  ASSERT_TRUE(project(k, RowClock{}, m, m.pose.t, rolling));
  ASSERT_TRUE(project(k, m.pose.t, plain));
  EXPECT_EQ(rolling, plain);
}

}  // namespace
}  // namespace onestroke::test
