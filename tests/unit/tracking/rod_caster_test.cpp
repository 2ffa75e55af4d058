// Rays against the rod's surface.

#include "tracking/rod_caster.h"

#include "view_fixture.h"

#include <gtest/gtest.h>

namespace onestroke::test {
namespace {

TEST(RodCaster, MeetsTheSurfacePointsThatTheRodModelPutsInSight) {
  RandomPose random;
  for (const double bend : {0.0, 8.0}) {
    const RodModel rod(angle_marker(3, bend));
    const RodCaster caster(rod);
    // A bend in six straight pieces is off its arc by less than this.
    const double tolerance = bend > 0 ? 0.15 : 1e-9;
    int met = 0;
    for (int i = 0; i < 20; ++i) {
      const EigenPose pose = to_eigen(random_view(random));
      const Vec3d eye = -pose.R.transpose() * pose.t;
      for (int c = 0; c < rod.cell_count(); ++c) {
        const RodModel::Section& section = rod.middle(c);
        const Vec3d x = rod.surface(section, eye, random.uniform(-1, 1));
        // At a mitre the other arm cuts the ring short.
        if (rod.hides_itself(section, x, eye) || std::abs(section.s - 72) < rod.radius()) continue;
        const RodCaster::Hit hit = caster.cast(eye, x - eye);
        ASSERT_TRUE(hit.hit) << "cell " << c;
        EXPECT_LT((hit.point - x).norm(), 20 * tolerance + 1e-6);
        EXPECT_NEAR(hit.s, section.s, 20 * tolerance + 1e-6);
        EXPECT_EQ(hit.gap, 0);
        ++met;
      }
    }
    EXPECT_GT(met, 400);
  }
}

TEST(RodCaster, MeetsTheEndDiscs) {
  const RodModel rod(angle_marker(3));
  const RodCaster caster(rod);
  const RodCaster::Hit stop = caster.cast({300, 1, -1}, {-1, 0, 0});
  ASSERT_TRUE(stop.hit);
  EXPECT_NEAR(stop.s, rod.length(), 1e-9);
  EXPECT_NEAR(stop.point.x(), 72, 1e-9);
  const RodCaster::Hit start = caster.cast({1, -300, 1}, {0, 1, 0});
  ASSERT_TRUE(start.hit);
  EXPECT_NEAR(start.s, 0, 1e-9);
  EXPECT_NEAR(start.point.y(), -72, 1e-9);
}

TEST(RodCaster, TellsHowFarARayPassesBy) {
  const RodModel rod(angle_marker(3));
  const RodCaster caster(rod);
  // Across the stop arm, 5 mm above its axis: 2 mm off a surface of radius 3.
  const RodCaster::Hit by = caster.cast({40, 100, 5}, {0, -1, 0});
  EXPECT_FALSE(by.hit);
  EXPECT_NEAR(by.gap, 2, 1e-9);
  EXPECT_NEAR(by.s, 72 + 40, 1e-9);
  EXPECT_NEAR(by.point.z(), 5, 1e-9);
}

TEST(RodCaster, SeesTheNearerArm) {
  const RodModel rod(angle_marker(3));
  const RodCaster caster(rod);
  // Along the bisector's plane both arms are hit; seen from beyond the start tip the start arm is first.
  const RodCaster::Hit hit = caster.cast({0, -200, 0.5}, {0, 1, 0});
  ASSERT_TRUE(hit.hit);
  EXPECT_LT(hit.s, 72);
}

}  // namespace
}  // namespace onestroke::test
