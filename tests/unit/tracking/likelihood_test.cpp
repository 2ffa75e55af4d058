// How likely a picture makes a pose.

#include "tracking/likelihood.h"

#include "tracking/roll_search.h"
#include "view_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace onestroke::test {
namespace {

TEST(VisibleOrCovered, SaysNothingWhereTheCellsSayNothing) {
  EXPECT_NEAR(visible_or_covered(std::vector<double>(36, 0.0)), 0, 1e-12);
}

TEST(VisibleOrCovered, ACoverCostsABoundedAmount) {
  EXPECT_GT(visible_or_covered(std::vector<double>(36, -100.0)), -10);
  EXPECT_LT(visible_or_covered(std::vector<double>(36, -100.0)), -3);
}

TEST(VisibleOrCovered, OneCoverIsLikelierThanManySmallOnes) {
  std::vector<double> run(36, 3.0), scattered(36, 3.0);
  for (std::size_t i = 0; i < 12; ++i) run[12 + i] = scattered[3 * i] = -4;
  EXPECT_GT(visible_or_covered(run), visible_or_covered(scattered) + 10);
}

// Against the sum over every way of covering a short row.
TEST(VisibleProbabilities, AreThoseOfAllWaysOfCovering) {
  const std::vector<double> ratios{2, -3, -4, 0.5, 1, -1, 6, -2};
  constexpr double begins = 0.04, ends = 0.15, seen = ends / (begins + ends);
  std::vector<double> expected(ratios.size(), 0.0);
  double all = 0;
  for (unsigned way = 0; way < 256; ++way) {
    double p = 1;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      const bool here = way >> i & 1U, before = i > 0 && (way >> (i - 1) & 1U);
      const double shown = i == 0 ? seen : before ? 1 - begins : ends;
      p *= here ? shown * std::exp(ratios[i]) : 1 - shown;
    }
    all += p;
    for (std::size_t i = 0; i < ratios.size(); ++i)
      if (way >> i & 1U) expected[i] += p;
  }
  std::vector<double> probabilities(ratios.size());
  visible_probabilities(ratios, probabilities);
  for (std::size_t i = 0; i < ratios.size(); ++i) EXPECT_NEAR(probabilities[i], expected[i] / all, 1e-9) << i;
  EXPECT_NEAR(visible_or_covered(ratios), std::log(all), 1e-9);
}

TEST(LikelihoodMeter, IsHighestWhereTheMarkerIs) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(4), other = angle_marker(5);
  const RodModel rod(marker), wrong(other);
  for (int i = 0; i < 8; ++i) {
    const Pose truth = random_view(random);
    const Shot shot = shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)});
    const Inks inks = inks_at(shot, rod, truth);
    const ImageView view = shot.view();
    const Surroundings around(view, shot.intrinsics, rod, to_eigen(truth));
    const LikelihoodMeter meter(view, shot.intrinsics, rod, inks, around);
    const LikelihoodMeter misread(view, shot.intrinsics, wrong, inks, around);
    const double here = meter(to_eigen(truth));
    EXPECT_GT(here, 40) << i;
    EXPECT_GT(here, misread(to_eigen(truth)) + 20) << i;
    EXPECT_GT(here, meter(to_eigen(disturbed(truth, random, 15, 5))) + 10) << i;
    EXPECT_GT(roll_margin(meter, to_eigen(truth)), 5) << i;
  }
}

TEST(LikelihoodMeter, LeavesTheRollOpenWhereAnArmIsCovered) {
  const MarkerSpec marker = angle_marker(4);
  const RodModel rod(marker);
  const Pose truth = about_middle(exp_so3({0.3, 0.2, 0.1}), {0, 0, 350});
  Shot shot = shoot(marker, truth);
  const Inks inks = inks_at(shot, rod, truth);
  Vec2d tip, corner;
  ASSERT_TRUE(project(shot.intrinsics, to_eigen(truth) * rod.edge(36).centre, tip));
  ASSERT_TRUE(project(shot.intrinsics, to_eigen(truth) * rod.edge(19).centre, corner));
  const ImageView view = shot.view();
  const auto margin = [&] {
    const Surroundings around(view, shot.intrinsics, rod, to_eigen(truth));
    return roll_margin(LikelihoodMeter(view, shot.intrinsics, rod, inks, around), to_eigen(truth));
  };
  const double open = margin();
  const Vec2d middle = (tip + corner) / 2;
  cover(shot, middle, static_cast<int>((tip - corner).norm() / 2) + 8, {93, 93, 93});
  EXPECT_GT(open, 5);
  EXPECT_LT(margin(), 4);
}

TEST(Mirrored, IsItsOwnInverseAndKeepsTheMiddle) {
  RandomPose random;
  const RodModel rod(angle_marker(4));
  for (int i = 0; i < 20; ++i) {
    const EigenPose pose = to_eigen(random_view(random)), other = mirrored(rod, pose), back = mirrored(rod, other);
    EXPECT_NEAR(other.R.determinant(), 1, 1e-9);
    EXPECT_LT((other * rod.centre() - pose * rod.centre()).norm(), 1e-9);
    EXPECT_LT((back.R - pose.R).norm(), 1e-9);
    // From the middle both tips lie in the same directions of the picture.
    const Vec3d a = pose.R * (rod.edge(0).centre - rod.centre()), b = other.R * (rod.edge(0).centre - rod.centre());
    const Vec3d view = (pose * rod.centre()).normalized();
    EXPECT_LT((view.cross(a) - view.cross(b)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace onestroke::test
