#include "tracking/initial_pose.h"

#include "../core/random_pose.h"
#include "marker_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace onestroke::test {
namespace {

Intrinsics camera() {
  return Intrinsics::from_fov(1600, 1200, 35 * radian);
}

/// Gravity centre of the part of a ring that faces the eye: over the projected width w in [-1, 1] the front stands
/// sqrt(1 - w^2) radii before the axis, pi / 4 on average.
Vec2d gravity_centre(const RodModel& rod, const EigenPose& pose, int cell) {
  const Vec3d eye = -pose.R.transpose() * pose.t;
  const RodModel::Section& m = rod.middle(cell);
  Vec3d out;
  rod.surface(m, eye, 0, &out);
  Vec2d pixel;
  EXPECT_TRUE(project(camera(), pose * Vec3d(m.centre + std::numbers::pi / 4 * rod.radius() * out), pixel));
  return pixel;
}

std::vector<CellPoint> seen(const RodModel& rod, const Pose& pose, int first, int last, double noise = 0) {
  std::mt19937 random(5);
  std::normal_distribution<double> error(0, noise > 0 ? noise : 1);
  std::vector<CellPoint> points;
  for (int c = first; c <= last; ++c) {
    Vec2d pixel = gravity_centre(rod, to_eigen(pose), c);
    if (noise > 0) pixel += Vec2d(error(random), error(random));
    points.push_back({c, pixel});
  }
  return points;
}

Pose random_view(RandomPose& random) {
  for (;;) {
    const Pose pose =
        about_middle(random.rotation(), {random.uniform(-40, 40), random.uniform(-30, 30), random.uniform(300, 700)});
    if (arms_in_sight(pose)) return pose;
  }
}

TEST(InitialPose, RandomPosesAreRecovered) {
  RandomPose random;
  for (const double bend : {0.0, 8.0}) {
    const RodModel rod(angle_marker(1, bend));
    for (int i = 0; i < 100; ++i) {
      const Pose truth = random_view(random);
      const std::vector<PoseGuess> guesses = poses_from_cells(camera(), rod, seen(rod, truth, 0, 35));
      ASSERT_FALSE(guesses.empty()) << i;
      const Pose found = from_eigen(guesses[0].pose);
      EXPECT_LT(turn_between(found, truth), 0.3) << i;
      EXPECT_LT(shift_between(found, truth), 1e-3) << i;
      EXPECT_LT(guesses[0].rms, 0.2) << i;
    }
  }
}

TEST(InitialPose, WeakPerspectiveRecoversRandomPosesToo) {
  RandomPose random;
  for (const double bend : {0.0, 8.0}) {
    const RodModel rod(angle_marker(1, bend));
    for (int i = 0; i < 100; ++i) {
      const Pose truth = random_view(random);
      const auto guesses = poses_in_weak_perspective(camera(), rod, seen(rod, truth, 0, 35));
      ASSERT_FALSE(guesses.empty()) << i;
      const Pose found = from_eigen(guesses[0].pose);
      EXPECT_LT(turn_between(found, truth), 0.3) << i;
      EXPECT_LT(shift_between(found, truth), 1e-3) << i;
    }
  }
}

TEST(InitialPose, WeakPerspectiveNeedsBothArms) {
  RandomPose random;
  const RodModel rod(angle_marker(1));
  EXPECT_TRUE(poses_in_weak_perspective(camera(), rod, seen(rod, random_view(random), 2, 15)).empty());
}

TEST(InitialPose, APartOfEachArmWillDoAndNoiseIsBorne) {
  RandomPose random;
  const RodModel rod(angle_marker(1));
  for (int i = 0; i < 60; ++i) {
    const Pose truth = random_view(random);
    std::vector<CellPoint> points = seen(rod, truth, 4, 12, 0.3);
    const std::vector<CellPoint> more = seen(rod, truth, 22, 31, 0.3);
    points.insert(points.end(), more.begin(), more.end());
    const std::vector<PoseGuess> guesses = poses_from_cells(camera(), rod, points);
    const bool good = std::any_of(guesses.begin(), guesses.end(), [&](const PoseGuess& g) {
      return turn_between(from_eigen(g.pose), truth) < 5 && shift_between(from_eigen(g.pose), truth) < 0.02;
    });
    EXPECT_TRUE(good) << i;
  }
}

// Seen from afar a plane tilted towards the eye looks as one tilted away; both must be offered, and the cells' distance
// from the plane then decides.
TEST(InitialPose, BothTiltsAreOffered) {
  const RodModel rod(angle_marker(1));
  const Quat tilted = exp_so3(40 * radian * normalized(Vec3{1, 1, 0}));
  const Pose truth = about_middle(tilted, {0, 0, 700});
  const std::vector<PoseGuess> guesses = poses_from_cells(camera(), rod, seen(rod, truth, 0, 35, 0.2));
  ASSERT_EQ(guesses.size(), 2u);
  EXPECT_LE(guesses[0].rms, guesses[1].rms);
  EXPECT_GT(turn_between(from_eigen(guesses[0].pose), from_eigen(guesses[1].pose)), 20);
  EXPECT_LT(
      std::min(turn_between(from_eigen(guesses[0].pose), truth), turn_between(from_eigen(guesses[1].pose), truth)), 3);
}

TEST(InitialPose, TooFewPointsGiveNone) {
  const RodModel rod(angle_marker(1));
  const Pose truth = about_middle({}, {0, 0, 400});
  EXPECT_TRUE(poses_from_cells(camera(), rod, {}).empty());
  EXPECT_TRUE(poses_from_cells(camera(), rod, seen(rod, truth, 17, 19)).empty());
}

TEST(InitialPose, PointsThatAllCoincideDoNotCrash) {
  const RodModel rod(angle_marker(1));
  std::vector<CellPoint> points;
  for (int c = 10; c < 26; ++c) points.push_back({c, {800, 600}});
  for (const PoseGuess& g : poses_from_cells(camera(), rod, points)) EXPECT_TRUE(g.pose.R.allFinite());
}

TEST(InitialPose, OneArmGivesItsPlaceAndDirection) {
  RandomPose random;
  const RodModel rod(angle_marker(1));
  int found = 0, best = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose truth = random_view(random);
    const int first = i % 2 ? 19 : 1;
    const std::vector<PoseGuess> guesses = poses_from_row(camera(), rod, seen(rod, truth, first, first + 15));
    ASSERT_FALSE(guesses.empty()) << i;
    for (std::size_t g = 1; g < guesses.size(); ++g) EXPECT_GE(guesses[g].rms, guesses[g - 1].rms);
    const RodModel::Section& m = rod.middle(first + 8);
    const bool good = std::any_of(guesses.begin(), guesses.end(), [&](const PoseGuess& g) {
      return (g.pose.R * m.tangent).dot(to_eigen(truth).R * m.tangent) > std::cos(2 * radian) &&
             (g.pose * m.centre - to_eigen(truth) * m.centre).norm() < 0.01 * norm(truth.translation);
    });
    found += good;
    best += good && guesses[0].rms < 0.05;
  }
  // An arm that points at the camera may be drawn to another tilt.
  EXPECT_GE(found, 56);
  EXPECT_GE(best, 50) << "the true tilt explains the points best";
}

TEST(InitialPose, AFitOfOneArmLeavesItsRoll) {
  const RodModel rod(angle_marker(1));
  const Pose truth = about_middle(exp_so3({0.4, 0.3, -0.2}), {10, -5, 450});
  PoseGuess guess;
  const Vec3 axis{0, 1, 0};
  const Pose rolled = truth * Pose{exp_so3(0.8 * axis), {}};
  guess.pose = to_eigen(rolled);
  ASSERT_TRUE(fit_cells(camera(), rod, seen(rod, truth, 0, 17), true, guess));
  EXPECT_LT(guess.rms, 0.05);
  EXPECT_NEAR(turn_between(from_eigen(guess.pose), truth), 0.8 / radian, 2);
}

}  // namespace
}  // namespace onestroke::test
