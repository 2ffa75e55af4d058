#include "tracking/rod_model.h"

#include "../core/random_pose.h"
#include "marker_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace onestroke::test {
namespace {

/// Distance from the centreline within a stretch of arc length, by sampling.
double distance_to_centreline(const Shape& shape, const Vec3d& p, double from, double to) {
  double best = 1e9;
  for (double s = from; s <= to; s += 0.1) best = std::min(best, (to_eigen(shape.at(s).position) - p).norm());
  return best;
}

TEST(RodModel, SurfacePointsLieOnTheRodAndInTheirSection) {
  RandomPose random;
  for (const double bend : {0.0, 8.0, 12.0}) {
    const MarkerSpec spec = angle_marker(1, bend);
    const RodModel rod(spec);
    for (int i = 0; i < 300; ++i) {
      const RodModel::Section section = i % 2 ? rod.edge(i % 37) : rod.middle(i % 36);
      const Vec3d eye = to_eigen(random.direction()) * random.uniform(300, 700);
      Vec3d normal;
      const Vec3d x = rod.surface(section, eye, random.uniform(-3.1, 3.1), &normal);
      EXPECT_NEAR((x - section.centre).cross(section.tangent).norm(), 3, 1e-9) << "off the axis by the radius";
      EXPECT_NEAR((x - section.centre).dot(section.cut), 0, 1e-9) << "in the plane of the section";
      EXPECT_NEAR(normal.norm(), 1, 1e-12);
      EXPECT_NEAR(normal.dot(section.tangent), 0, 1e-12);
      // Near a sharp corner, on its inner side, a straight arm's surface runs into the other arm.
      if (bend > 0 || std::abs(section.s - 72) > 6) {
        EXPECT_NEAR(distance_to_centreline(spec.shape, x, std::max(0.0, section.s - 12), section.s + 12), 3, 0.01);
      }
    }
  }
}

TEST(RodModel, PhiZeroFacesTheEyeAndPhiTurnsRound) {
  const RodModel rod(angle_marker(1));
  const Vec3d eye(-300, -30, -400);
  for (const int cell : {2, 17, 20, 33}) {
    const RodModel::Section& m = rod.middle(cell);
    Vec3d front, side, back;
    rod.surface(m, eye, 0, &front);
    rod.surface(m, eye, std::numbers::pi / 2, &side);
    rod.surface(m, eye, std::numbers::pi, &back);
    const Vec3d view = eye - m.centre;
    EXPECT_GT(front.dot(view), 0);
    EXPECT_NEAR(side.dot(view), 0, 1e-9);
    EXPECT_LT((front + back).norm(), 1e-12);
  }
}

TEST(RodModel, LookingDownTheAxisStillGivesASurfacePoint) {
  const RodModel rod(angle_marker(1));
  const Vec3d x = rod.surface(rod.middle(30), rod.middle(30).centre + Vec3d(400, 0, 0), 0.3);
  ASSERT_TRUE(x.allFinite());
  EXPECT_NEAR((x - rod.middle(30).centre).norm(), 3, 1e-9);
}

TEST(RodModel, TheMitreLiesInTheBisectingPlane) {
  const RodModel rod(angle_marker(1));
  const RodModel::Section& corner = rod.edge(18);
  EXPECT_LT(corner.centre.norm(), 1e-9);
  const Vec3d bisector = Vec3d(1, 1, 0).normalized();
  EXPECT_NEAR(std::abs(corner.cut.dot(bisector)), 1, 1e-12);
  // Both rods pass through the mitre's ellipse: a point of it is 3 mm from either axis.
  const Vec3d x = rod.surface(corner, {100, 50, -400}, 0.7);
  EXPECT_NEAR(std::hypot(x.x(), x.z()), 3, 1e-9);
  EXPECT_NEAR(std::hypot(x.y(), x.z()), 3, 1e-9);
}

TEST(RodModel, SectionsFollowTheDefinition) {
  const RodModel sharp(angle_marker(1)), bent(angle_marker(1, 12));
  EXPECT_EQ(sharp.cell_count(), 36);
  EXPECT_EQ(sharp.length(), 144);
  EXPECT_LT((sharp.edge(0).centre - Vec3d(0, -72, 0)).norm(), 1e-9);
  EXPECT_LT((sharp.middle(0).centre - Vec3d(0, -70, 0)).norm(), 1e-9);
  EXPECT_LT((sharp.edge(36).centre - Vec3d(72, 0, 0)).norm(), 1e-9);
  const double tip = 72 - std::numbers::pi * 12 / 4 + 12;
  EXPECT_LT((bent.edge(0).centre - Vec3d(0, -tip, 0)).norm(), 1e-9);
  // The arc's middle is the boundary of the two middle cells, nearest to the corner by r (sqrt 2 - 1).
  EXPECT_NEAR(bent.edge(18).centre.norm(), 12 * (std::numbers::sqrt2 - 1), 1e-9);
  EXPECT_LT((bent.section_at(72).centre - bent.edge(18).centre).norm(), 1e-12);
}

TEST(RodModel, ArmsAndWhereTheyMeet) {
  const RodModel sharp(angle_marker(1)), bent(angle_marker(1, 12)),
      line({1, "l", encode(5, 36), Shape::line(36, 4, 3), ""});
  for (int cell = 0; cell < 36; ++cell) {
    EXPECT_EQ(sharp.arm_of(cell), cell < 18 ? 0 : 1);
    EXPECT_EQ(line.arm_of(cell), 0);
    // The arc takes 6 pi mm, 9.42 to either side of the middle: cells 16 to 19 have their middles in it.
    EXPECT_EQ(bent.arm_of(cell), cell < 16 ? 0 : cell < 20 ? -1 : 1) << cell;
  }
  EXPECT_NEAR(sharp.meeting(0).on_arm, 72, 1e-9);
  EXPECT_NEAR(sharp.meeting(0).on_next, 72, 1e-9);
  EXPECT_NEAR(bent.meeting(0).on_arm, 72 - 3 * std::numbers::pi + 12, 1e-9);
  EXPECT_NEAR(bent.meeting(0).on_next, 72 + 3 * std::numbers::pi - 12, 1e-9);
  EXPECT_TRUE(sharp.has_roll());
  EXPECT_FALSE(line.has_roll());
}

// But for the outer edge of a mitre, which stands out by a fifth of the radius more.
TEST(RodModel, TheBoundingSphereHoldsTheRod) {
  RandomPose random;
  for (const double bend : {0.0, 12.0}) {
    const RodModel rod(angle_marker(1, bend));
    for (int i = 0; i < 400; ++i) {
      const Vec3d x = rod.surface(rod.middle(i % 36), to_eigen(random.direction()) * 400, random.uniform(-3, 3));
      EXPECT_LE((x - rod.centre()).norm(), rod.bounding_radius() + 1e-9);
    }
  }
}

/// How near the line of sight from a surface point comes to the centreline, the stretch about the point left out.
double clearance(const Shape& shape, double at, const Vec3d& point, const Vec3d& eye) {
  const Vec3d towards = (eye - point).normalized();
  double best = 1e9;
  for (double s = 0; s <= shape.length(); s += 0.1) {
    if (std::abs(s - at) < 6) continue;
    const Vec3d c = to_eigen(shape.at(s).position) - point;
    const double along = std::max(0.5, c.dot(towards));
    best = std::min(best, (c - along * towards).norm());
  }
  return best;
}

TEST(RodModel, HidesItselfAsRaysSay) {
  RandomPose random;
  const std::vector<Vec3> staircase{{0, 0, 0}, {0, 48, 0}, {48, 48, 0}, {48, 48, 48}};
  const std::vector<MarkerSpec> specs{
      angle_marker(1), angle_marker(1, 12), {1, "s", encode(77, 36), Shape::stroke(36, 4, 3, 0, staircase), ""}};
  for (const MarkerSpec& spec : specs) {
    const RodModel rod(spec);
    int hidden = 0, open = 0;
    for (int i = 0; i < 4000; ++i) {
      // Rays that graze a rod are rare; half of the eyes look along the plane of the arms.
      Vec3 from = random.direction();
      if (i % 2) from.z *= 0.15;
      const Vec3d eye = rod.centre() + to_eigen(random.uniform(300, 700) * normalized(from));
      const RodModel::Section& section = rod.middle(i % 36);
      Vec3d normal;
      const Vec3d x = rod.surface(section, eye, random.uniform(-0.95, 0.95), &normal);
      if (normal.dot((eye - x).normalized()) < 0.15) continue;
      const double near = clearance(spec.shape, section.s, x, eye);
      // Within a tenth of the radius either answer is as good.
      if (near < 0.85 * 3) {
        EXPECT_TRUE(rod.hides_itself(section, x, eye)) << spec.name << " cell " << i % 36 << " clearance " << near;
        ++hidden;
      } else if (near > 1.1 * 3) {
        EXPECT_FALSE(rod.hides_itself(section, x, eye)) << spec.name << " cell " << i % 36 << " clearance " << near;
        ++open;
      }
    }
    EXPECT_GT(hidden, 50);
    EXPECT_GT(open, 1000);
  }
}

}  // namespace
}  // namespace onestroke::test
