#include "tracking/blur_search.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace onestroke {
namespace {

constexpr double middle = 400;
constexpr DepthRange range{360, 450};
constexpr std::array<double, 7> sigmas{0.5, 1, 2, 3, 4, 5, 6};
constexpr std::array<double, 12> ends{-6, -5, -4, -3, -2, -1, 1, 2, 3, 4, 5, 6};

// Worth most where the blurs between the two ends are those of a camera focused at a depth.
BlurWorth likes(const CameraBlur& truth) {
  return [truth](const CameraBlur& blur) {
    double worth = 0;
    for (double z = range.near; z <= range.far; z += 10) worth -= std::pow(blur.at(z) - truth.at(z), 2);
    return worth;
  };
}

CameraBlur with_ends(double near, double far) {
  const double slope = (near - far) / (middle / range.near - middle / range.far);
  return {near - slope * (middle / range.near - 1), slope, middle};
}

TEST(CameraBlur, IsNothingInFocusAndGrowsToBothSides) {
  const CameraBlur blur = with_ends(3, -3);
  const double focus = 2 / (1 / range.near + 1 / range.far);
  EXPECT_NEAR(blur.defocus(focus), 0, 1e-12);
  EXPECT_NEAR(blur.at(range.near), 3, 1e-12);
  EXPECT_NEAR(blur.at(range.far), 3, 1e-12);
  EXPECT_GT(blur.at(focus), 0);
  EXPECT_NEAR(blur.scaled(0.5).defocus(range.near), 1.5, 1e-12);
}

TEST(BlurSearch, FindsAnEvenBlur) {
  const CameraBlur found = best_even_blur({0.6, 7, middle}, sigmas, likes({4, 0, middle}));
  EXPECT_EQ(found.sigma, 4);
  EXPECT_EQ(found.by_nearness, 0);
  EXPECT_EQ(found.middle, middle);
}

TEST(BlurSearch, NearByGoesNoFurtherThanOneStepAtATime) {
  // Two blurs are worth something, and the way to the better one is barred.
  const BlurWorth worth = [](const CameraBlur& b) { return b.sigma == 6 ? 2.0 : b.sigma == 1 ? 1.0 : 0.0; };
  EXPECT_EQ(best_even_blur({1, 0, middle}, sigmas, worth).sigma, 6);
  EXPECT_EQ(best_even_blur_near_by({1, 0, middle}, sigmas, worth).sigma, 1);
  const BlurWorth wider = [](const CameraBlur& b) { return b.sigma; };
  EXPECT_EQ(best_even_blur_near_by({4, 0, middle}, sigmas, wider).sigma, 6);
}

TEST(BlurSearch, FindsTheBlursOfBothEnds) {
  for (const auto& [near, far] : {std::pair{5.0, 1.0}, {1.0, 4.0}, {3.0, 3.0}, {4.0, -2.0}}) {
    const CameraBlur truth = with_ends(near, far);
    const CameraBlur found = best_blur_by_depth({2, 0, middle}, range, {.candidates = ends, .rounds = 6}, likes(truth));
    EXPECT_NEAR(found.at(range.near), truth.at(range.near), 0.01) << near << ' ' << far;
    EXPECT_NEAR(found.at(range.far), truth.at(range.far), 0.01) << near << ' ' << far;
  }
}

TEST(BlurSearch, RefinesWhatThereIs) {
  constexpr std::array<double, 4> times{0.8, 0.9, 1.1, 1.25};
  const CameraBlur start = with_ends(4.5, 1.2), truth = with_ends(4, 1);
  const BlurWorth worth = likes(truth);
  const CameraBlur found =
      best_blur_by_depth(start, range, {.candidates = times, .relative = true, .rounds = 4}, worth);
  EXPECT_GT(worth(found), 0.1 * worth(start));
  EXPECT_NEAR(found.at(range.near), 4, 0.2);
  EXPECT_NEAR(found.at(range.far), 1, 0.2);
}

TEST(BlurSearch, KeepsWithinTheWidest) {
  const CameraBlur found =
      best_blur_by_depth({2, 0, middle}, range, {.candidates = ends, .rounds = 3, .widest = 3}, likes(with_ends(6, 6)));
  EXPECT_LE(found.at(range.near), 3);
  EXPECT_LE(found.at(range.far), 3);
}

TEST(BlurSearch, LeavesAloneWhatLiesAtOneDepth) {
  int asked = 0;
  const CameraBlur start{2, 0, middle};
  const CameraBlur found = best_blur_by_depth(start, {398, 402}, {.candidates = ends}, [&](const CameraBlur&) {
    ++asked;
    return 0.0;
  });
  EXPECT_EQ(found.sigma, start.sigma);
  EXPECT_EQ(found.by_nearness, 0);
  EXPECT_EQ(asked, 0);
}

}  // namespace
}  // namespace onestroke
