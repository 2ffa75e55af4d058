#include "render/lens_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace onestroke {
namespace {

constexpr int width = 1280, height = 720;

Intrinsics lens(double fov_deg, std::array<double, 5> distortion) {
  Intrinsics k = Intrinsics::from_fov(width, height, fov_deg * 3.14159265358979 / 180);
  k.distortion = distortion;
  return k;
}

const std::array lenses{lens(60, {-0.28, 0.09, 0.001, -0.002, 0}), lens(75, {-0.3, 0.12, 0.0005, 0.001, -0.02}),
                        lens(85, {-0.2, 0.05, 0, 0, 0}), lens(70, {0.12, -0.03, 0, 0.001, 0})};

/// The shift as the shader looks it up: linear between the four texels round a place.
std::array<double, 2> look_up(const LensMap& map, double x, double y) {
  const auto place = map.placement();
  const double u = (x * double{place[0]} + double{place[2]}) * LensMap::width - 0.5;
  const double v = (y * double{place[1]} + double{place[3]}) * LensMap::height - 0.5;
  const int column = std::clamp(static_cast<int>(u), 0, LensMap::width - 2);
  const int row = std::clamp(static_cast<int>(v), 0, LensMap::height - 2);
  std::array<double, 2> shift{};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const double share = (j ? u - column : 1 - (u - column)) * (i ? v - row : 1 - (v - row));
      for (std::size_t axis = 0; axis < 2; ++axis)
        shift[axis] +=
            share * double{map.shifts[2 * static_cast<std::size_t>((row + i) * LensMap::width + column + j) + axis]};
    }
  return shift;
}

TEST(LensMap, IsRightToAHundredthOfAPixelInsideThePicture) {
  for (const Intrinsics& k : lenses) {
    const PlaneBounds bounds = picture_bounds(k, width, height, 0.1);
    const LensMap map = make_lens_map(k, width, height, bounds);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(bounds.left, bounds.right), y(bounds.top, bounds.bottom);
    double worst = 0;
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const double nx = x(random), ny = y(random);
      if (nx * nx + ny * ny > distortion_limit(k)) continue;  // the picture ends before
      const auto [u, v] = through_lens(k, nx, ny);
      if (u < 0 || v < 0 || u > width || v > height) continue;
      ++inside;
      const auto [shift_x, shift_y] = look_up(map, nx, ny);
      worst = std::max(
          {worst, std::abs(k.fx * nx + k.cx + shift_x * width - u), std::abs(k.fy * ny + k.cy + shift_y * height - v)});
    }
    EXPECT_GT(inside, 5000);
    EXPECT_LT(worst, 0.01) << k.distortion[0];
  }
}

TEST(LensMap, UndoesTheLens) {
  for (const Intrinsics& k : lenses)
    for (const double u : {0.0, 200.0, 640.0, 1279.0})
      for (const double v : {0.0, 350.0, 719.0}) {
        const auto [x, y] = without_lens(k, u, v);
        const auto [back_u, back_v] = through_lens(k, x, y);
        EXPECT_NEAR(back_u, u, 1e-4) << k.distortion[0];
        EXPECT_NEAR(back_v, v, 1e-4) << k.distortion[0];
      }
}

TEST(LensMap, CoversThePictureAndItsMargin) {
  for (const Intrinsics& k : lenses) {
    const PlaneBounds bounds = picture_bounds(k, width, height, 0.1);
    for (const double u : {-71.0, 640.0, 1351.0})
      for (const double v : {-71.0, 360.0, 791.0}) {
        const auto [x, y] = without_lens(k, u, v);
        EXPECT_TRUE(x >= bounds.left && x <= bounds.right && y >= bounds.top && y <= bounds.bottom) << u << " " << v;
      }
  }
}

TEST(LensMap, FindsWhereThereIsNothingButPicture) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (const Intrinsics& k : lenses) {
    const PlaneBounds inside = inner_bounds(k, width, height), all = picture_bounds(k, width, height, 0);
    for (int i = 0; i < 500; ++i) {
      const double x = inside.left + share(random) * (inside.right - inside.left);
      const double y = inside.top + share(random) * (inside.bottom - inside.top);
      const auto [u, v] = through_lens(k, x, y);
      EXPECT_TRUE(u > -0.1 && u < width + 0.1 && v > -0.1 && v < height + 0.1) << u << " " << v;
    }
    const auto area = [](const PlaneBounds& b) { return (b.right - b.left) * (b.bottom - b.top); };
    EXPECT_GT(area(inside), 0.6 * area(all));
  }
  const Intrinsics ideal = lens(60, {});
  const PlaneBounds inside = inner_bounds(ideal, width, height), all = picture_bounds(ideal, width, height, 0);
  EXPECT_NEAR(inside.left, all.left, 1e-12);
  EXPECT_NEAR(inside.bottom, all.bottom, 1e-12);
}

TEST(LensMap, LimitsTheLensToWhereItDoesNotFold) {
  Intrinsics ideal = lens(60, {});
  EXPECT_GE(distortion_limit(ideal), 99);
  const Intrinsics barrel = lens(60, {-0.3, 0, 0, 0, 0});
  // r (1 - 0.3 r^2) turns back where r^2 = 1 / 0.9.
  EXPECT_NEAR(distortion_limit(barrel), 1 / 0.9, 0.051);
  EXPECT_LE(distortion_limit(barrel), 1 / 0.9);
  double before = 0;
  for (double r = 0.05; r < 4; r += 0.05) {
    const double u = through_lens(barrel, r, 0)[0];
    EXPECT_GT(u, before) << r;
    before = u;
  }
}

}  // namespace
}  // namespace onestroke
