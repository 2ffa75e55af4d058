// What two cameras tell together, on pictures of the synthetic renderer, where the truth is exact.

#include "score.h"
#include "stereo_set.h"

#include <gtest/gtest.h>

namespace onestroke::accuracy {
namespace {

// Some of the orientations of the README's table.
constexpr int few = 16;

void expect_all_there(const StereoScores& scores) {
  EXPECT_EQ(scores.both.wrong, 0);
  EXPECT_GE(scores.both.measured, std::max(scores.left.measured, scores.right.measured));
}

TEST(Stereo, TellsAnyPoseBetterThanEither) {
  const StereoScores scores = measure_pairs(StereoScene::any_orientation, few);
  expect_all_there(scores);
  EXPECT_EQ(scores.both.measured, few);
  for (const StereoScore* one : {&scores.left, &scores.right}) {
    EXPECT_LT(quantile(scores.both.position_mm, 0.5), quantile(one->position_mm, 0.5));
    EXPECT_LT(quantile(scores.both.position_mm, 1), quantile(one->position_mm, 1));
  }
}

TEST(Stereo, TellsAnArmThatPointsAtOneCamera) {
  constexpr int pointing = 12;  // they take seconds each
  const StereoScores scores = measure_pairs(StereoScene::pointing, pointing);
  expect_all_there(scores);
  EXPECT_LT(quantile(scores.both.rotation_deg, 0.5), 0.5 * quantile(scores.left.rotation_deg, 0.5));
  EXPECT_LT(quantile(scores.both.position_mm, 0.5), quantile(scores.left.position_mm, 0.5));
}

}  // namespace
}  // namespace onestroke::accuracy
