#include "tracking/candidate_groups.h"

#include "marker_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace onestroke::test {
namespace {

PoseCandidate standing_at(const RodModel& rod, const Vec3d& middle, double turn, double likelihood) {
  EigenPose pose;
  pose.R = Eigen::AngleAxisd(turn, Vec3d(1, 2, -1).normalized()).toRotationMatrix();
  pose.t = middle - pose.R * rod.centre();
  return {0, pose, {}, 0, likelihood};
}

TEST(CandidateGroups, StandWhereTheirFirstStandsHoweverHeld) {
  const RodModel rod(angle_marker(1));
  // A speckle far away reads likelier than the rod.
  const std::vector<PoseCandidate> candidates{
      standing_at(rod, {0, 0, 2000}, 0, 90),     standing_at(rod, {20, 0, 500}, 0, 60),
      standing_at(rod, {100, 0, 2100}, 2, 50),   standing_at(rod, {0, 30, 520}, 3, 40),
      standing_at(rod, {-200, 0, 500}, 0.1, 30), standing_at(rod, {30, -10, 480}, 1, 20),
  };
  const auto groups = group_by_place(rod, candidates);
  const std::vector<std::vector<double>> expected{{90, 50}, {60, 40, 20}, {30}};
  ASSERT_EQ(groups.size(), expected.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<double> likelihoods;
    for (const PoseCandidate& c : groups[g]) likelihoods.push_back(c.likelihood);
    EXPECT_EQ(likelihoods, expected[g]);
  }
}

}  // namespace
}  // namespace onestroke::test
