#include "render/level_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace onestroke {
namespace {

View view_of(const Pose& T_world_view = {}) {
  return {T_world_view, {-0.5, 0.5, 0.5, -0.5}, {0, 0, 1000, 1000}};
}

TEST(LevelChoice, TakesTheCoarsestWhoseErrorIsNotSeen) {
  const std::array errors{0.0F, 0.001F, 0.01F, 0.1F};
  EXPECT_EQ(choose_level(errors, 1), 3U);
  EXPECT_EQ(choose_level(errors, 4.9), 3U);
  EXPECT_EQ(choose_level(errors, 5.1), 2U);
  EXPECT_EQ(choose_level(errors, 51), 1U);
  EXPECT_EQ(choose_level(errors, 510), 0U);
  EXPECT_EQ(choose_level(errors, INFINITY), 0U);
  EXPECT_EQ(choose_level(errors, 0), 3U) << "what is not seen may be as coarse as it likes";
  EXPECT_EQ(choose_level(std::array{0.0F}, 1), 0U);
}

TEST(LevelChoice, NearerIsLarger) {
  // A thousand pixels a unit of tangent, measured at the near side of the ball.
  EXPECT_NEAR(pixels_per_millimetre(view_of(), {{0, 0, 600}, 0}), 1000 / 600.0, 1e-9);
  EXPECT_NEAR(pixels_per_millimetre(view_of(), {{0, 0, 600}, 100}), 1000 / 500.0 * std::hypot(1, 0.2), 1e-9);
  EXPECT_EQ(pixels_per_millimetre(view_of(), {{0, 0, 90}, 100}), INFINITY);
  EXPECT_EQ(pixels_per_millimetre(view_of(), {{0, 0, -200}, 100}), 0);
}

TEST(LevelChoice, FollowsTheView) {
  const Pose T{exp_so3({0.3, -1, 0.2}), {40, -70, 900}};
  EXPECT_NEAR(pixels_per_millimetre(view_of(T), {T * Vec3{10, 20, 600}, 50}),
              pixels_per_millimetre(view_of(), {{10, 20, 600}, 50}), 1e-9);
}

// No step in the ball, in any direction, moves by more pixels than is said.
TEST(LevelChoice, IsNeverTooLow) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> one(-1, 1);
  const View view = view_of();
  const auto pixel = [&](Vec3 p) { return std::array{1000 * p.x / p.z, 1000 * p.y / p.z}; };
  for (int round = 0; round < 2000; ++round) {
    const Ball ball{{300 * one(random), 300 * one(random), 700 + 200 * one(random)}, 40};
    const double most = pixels_per_millimetre(view, ball);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = ball.centre_world + 40 * normalized(Vec3{one(random), one(random), one(random)});
      if (std::abs(p.x / p.z) > 0.5 || std::abs(p.y / p.z) > 0.5) continue;
      const double step = 1e-4;
      const auto a = pixel(p), b = pixel(p + step * normalized(Vec3{one(random), one(random), one(random)}));
      EXPECT_LE(std::hypot(b[0] - a[0], b[1] - a[1]), most * step * 1.0001);
    }
  }
}

}  // namespace
}  // namespace onestroke
