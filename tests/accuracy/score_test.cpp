#include "score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke::accuracy {
namespace {

constexpr double degree = 3.14159265358979 / 180;

FrameRecord report(std::initializer_list<std::pair<int, Pose>> markers) {
  FrameRecord record;
  record.cost = Duration::from_ms(5);
  for (const auto& [id, pose] : markers) {
    record.markers[static_cast<std::size_t>(record.marker_count)].id = id;
    record.markers[static_cast<std::size_t>(record.marker_count++)].T_camera_marker = pose;
  }
  return record;
}

/// The marker's middle on the camera's axis, turned about it.
Pose posed(double degrees, double distance) {
  const Quat turn = exp_so3({0, 0, degrees * degree});
  return {turn, Vec3{0, 0, distance} - rotate(turn, {24, -24, 0})};
}

Score scored(const Truth& truth, const FrameRecord& record) {
  Score score;
  score.add("picture", {&truth, 1}, record);
  return score;
}

TEST(Score, ErrorsAreThoseOfThePose) {
  const Score s = scored({1, posed(0, 400), 36}, report({{1, posed(3, 404)}}));
  EXPECT_EQ(s.found, 1);
  EXPECT_EQ(s.asked, 1);
  EXPECT_TRUE(s.missed.empty() && s.wrong.empty());
  EXPECT_NEAR(s.rotation_deg[0], 3, 1e-6);
  EXPECT_NEAR(s.distance_pct[0], 1, 1e-9);
  EXPECT_EQ(s.ms[0], 5);
}

TEST(Score, WrongNamesTurnsAndPlacesAreFalseAndMissed) {
  const Truth truth{1, posed(0, 400), 36};
  for (const auto& [id, pose, flips] :
       {std::tuple{2, posed(0, 400), 0}, {1, posed(11, 400), 1}, {1, posed(0, 421), 0}}) {
    const Score s = scored(truth, report({{id, pose}}));
    EXPECT_EQ(s.found, 0);
    EXPECT_EQ(s.missed.size(), 1u);
    EXPECT_EQ(s.wrong.size(), 1u);
    EXPECT_EQ(s.flips, flips);
  }
}

TEST(Score, HiddenMarkersAreNotAskedForButCountWhereFound) {
  EXPECT_EQ(scored({1, posed(0, 400), 11}, report({})).asked, 0);
  EXPECT_EQ(scored({1, posed(0, 400), 12}, report({})).missed.size(), 1u);
  const Score s = scored({1, posed(0, 400), 11}, report({{1, posed(0, 400)}}));
  EXPECT_EQ(s.found, 1);
  EXPECT_EQ(s.asked, 1);
  EXPECT_EQ(scored({1, posed(0, 400), 11}, report({{1, posed(90, 400)}})).wrong.size(), 1u);
}

TEST(Score, TheSecondReportOfAMarkerIsFalse) {
  const Score s = scored({1, posed(0, 400), 36}, report({{1, posed(0, 400)}, {1, posed(1, 400)}}));
  EXPECT_EQ(s.found, 1);
  EXPECT_EQ(s.wrong.size(), 1u);
}

TEST(Score, Quantiles) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({3, 1, 2}, 1), 3);
  EXPECT_EQ(quantile({7}, 0.95), 7);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

}  // namespace
}  // namespace onestroke::accuracy
