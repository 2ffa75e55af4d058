// Poses fitted to the whole look of the rod.

#include "tracking/photometric_fit.h"

#include "view_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace onestroke::test {
namespace {

PhotometricFit fit(const Shot& shot, const RodModel& rod, const Pose& truth, const Pose& start,
                   const PhotometricOptions& options = {}) {
  const Inks inks = inks_at(shot, rod, truth);
  const ImageView view = shot.view();
  const Surroundings around(view, shot.intrinsics, rod, to_eigen(start));
  return fit_photometric(view, shot.intrinsics, rod, inks, around, to_eigen(start), options);
}

TEST(PhotometricFit, ComesBackFromADisturbedStart) {
  for_disturbed_starts([](const RodModel& rod, const Shot& shot, const Pose& truth, const Pose& start) {
    const PhotometricFit f = fit(shot, rod, truth, start);
    ASSERT_TRUE(f.valid);
    EXPECT_LT(turn_between(from_eigen(f.pose), truth), 0.6);
    EXPECT_LT(shift_between(from_eigen(f.pose), truth), 3e-3);
    EXPECT_GT(f.likelihood, 60);
  });
}

TEST(PhotometricFit, SeesThroughDefocusAsWideAsARing) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  for (int i = 0; i < 6; ++i) {
    const Pose truth = random_view(random);
    const Shot shot = shoot(marker, truth, {.blur = 3.5, .seed = static_cast<std::uint64_t>(i)});
    const PhotometricFit f = fit(shot, rod, truth, disturbed(truth, random, 1, 0.5));
    ASSERT_TRUE(f.valid) << i;
    EXPECT_LT(turn_between(from_eigen(f.pose), truth), 1.0) << i;
    const PhotometricFit sharp = fit(shoot(marker, truth), rod, truth, truth);
    EXPECT_GT(f.blur.sigma, 1.5) << i;
    EXPECT_LT(sharp.blur.sigma, 1.5) << i;
  }
}

/// Spreads each pixel evenly over a disc, in linear light, as a lens out of focus does.
void defocus(Shot& shot, int radius) {
  std::vector<float> linear(shot.image.rgb.size());
  std::transform(shot.image.rgb.begin(), shot.image.rgb.end(), linear.begin(),
                 [](std::uint8_t v) { return std::pow(static_cast<float>(v) / 255, 2.2F); });
  const int width = shot.image.width, height = shot.image.height;
  for (int y = radius; y < height - radius; ++y)
    for (int x = radius; x < width - radius; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        int count = 0;
        for (int dy = -radius; dy <= radius; ++dy)
          for (int dx = -radius; dx <= radius; ++dx) {
            if (dx * dx + dy * dy > radius * radius) continue;
            sum += linear[static_cast<std::size_t>(3 * ((y + dy) * width + x + dx) + c)];
            ++count;
          }
        shot.image.rgb[static_cast<std::size_t>(3 * (y * width + x) + c)] =
            static_cast<std::uint8_t>(std::lround(255 * std::pow(sum / count, 1 / 2.2)));
      }
}

TEST(PhotometricFit, MeasuresARodOutOfFocusFromWhereItsEdgesLeftIt) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  constexpr int radius = 7;
  std::vector<double> turns;
  for (int i = 0; i < 9; ++i) {
    const Pose truth = random_view(random);
    Shot shot = shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)});
    defocus(shot, radius);
    const PhotometricFit f = fit(shot, rod, truth, disturbed(truth, random, 1, 0.5), {.near = true});
    ASSERT_TRUE(f.valid) << i;
    turns.push_back(turn_between(from_eigen(f.pose), truth));
    EXPECT_LT(turns.back(), 0.6) << i;
    EXPECT_LT(shift_between(from_eigen(f.pose), truth), 4e-3) << i;
    // The radius of a disc is twice its standard deviation along an axis.
    EXPECT_GT(f.blur.sigma, 0.35 * radius) << i;
    EXPECT_LT(f.blur.sigma, 0.65 * radius) << i;
  }
  std::nth_element(turns.begin(), turns.begin() + 4, turns.end());
  EXPECT_LT(turns[4], 0.4);
}

TEST(PhotometricFit, MeasuresAnArmThatPointsAtTheCamera) {
  const MarkerSpec marker = angle_marker(6);
  const RodModel rod(marker);
  for (const double degrees : {4.0, 8.0, 12.0}) {
    const Pose truth = end_on_view(degrees, 350);
    const Shot shot = shoot(marker, truth);
    const Pose start = about_middle(exp_so3({0.02, -0.02, 0.02}) * truth.rotation, truth * Vec3{24, -24, 0});
    const PhotometricFit f = fit(shot, rod, truth, start);
    ASSERT_TRUE(f.valid) << degrees;
    EXPECT_LT(turn_between(from_eigen(f.pose), truth), 1.0) << degrees;
  }
}

TEST(PhotometricFit, PrefersTheTruthToAnotherPose) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(7);
  const RodModel rod(marker);
  for (int i = 0; i < 6; ++i) {
    const Pose truth = random_view(random);
    const Shot shot = shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)});
    const PhotometricFit here = fit(shot, rod, truth, truth, {.fit = false, .blur = CameraBlur{0.6}});
    const PhotometricFit beside =
        fit(shot, rod, truth, disturbed(truth, random, 6, 1), {.fit = false, .blur = CameraBlur{0.6}});
    ASSERT_TRUE(here.valid);
    EXPECT_LT(turn_between(from_eigen(here.pose), truth), 1e-6);
    EXPECT_GT(here.likelihood, (beside.valid ? beside.likelihood : 0) + 10) << i;
  }
}

/// Where a section of the rod stands in the picture.
Vec2d pixel_of(const Shot& shot, const Pose& pose, const Vec3d& point) {
  Vec2d pixel;
  EXPECT_TRUE(project(shot.intrinsics, to_eigen(pose) * point, pixel));
  return pixel;
}

constexpr std::array<int, 3> skin{205, 150, 125};

TEST(PhotometricFit, FingersDoNotDrawItAway) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  RandomPose random;
  for (int i = 0; i < 6; ++i) {
    const Pose truth = random_view(random);
    Shot shot = shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)});
    const Inks inks = inks_at(shot, rod, truth);
    for (const int cell : {6, 12, 27}) cover(shot, pixel_of(shot, truth, rod.middle(cell).centre), 22, skin);
    const ImageView view = shot.view();
    const EigenPose start = to_eigen(disturbed(truth, random, 1, 0.5));
    const Surroundings around(view, shot.intrinsics, rod, start);
    const PhotometricFit f = fit_photometric(view, shot.intrinsics, rod, inks, around, start);
    ASSERT_TRUE(f.valid) << i;
    EXPECT_LT(turn_between(from_eigen(f.pose), truth), 1.0) << i;
    EXPECT_GT(f.weakest_arm, 1) << i;
    EXPECT_GT(f.proof, 40) << i;
  }
}

TEST(PhotometricFit, AnArmThatIsCoveredShowsNothing) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose truth = about_middle(exp_so3({0.3, 0.2, 0.1}), {0, 0, 350});
  Shot shot = shoot(marker, truth);
  const Inks inks = inks_at(shot, rod, truth);
  const auto weakest = [&] {
    const Surroundings around(shot.view(), shot.intrinsics, rod, to_eigen(truth));
    const PhotometricFit f = fit_photometric(shot.view(), shot.intrinsics, rod, inks, around, to_eigen(truth),
                                             {.fit = false, .blur = CameraBlur{0.6}});
    EXPECT_TRUE(f.valid);
    return f.weakest_arm;
  };
  EXPECT_GT(weakest(), 30);
  const Vec2d tip = pixel_of(shot, truth, rod.edge(36).centre), corner = pixel_of(shot, truth, rod.edge(19).centre);
  cover(shot, (tip + corner) / 2, static_cast<int>((tip - corner).norm() / 2) + 8, skin);
  EXPECT_LT(weakest(), 1);
}

TEST(PhotometricFit, APlainThingIsNoRod) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose pose = about_middle(exp_so3({0.3, 0.2, 0.1}), {0, 0, 350});
  Shot shot = shoot(marker, pose);
  const Inks inks = inks_at(shot, rod, pose);
  for (int cell = 0; cell < rod.cell_count(); ++cell)
    cover(shot, pixel_of(shot, pose, rod.middle(cell).centre), 16, skin);
  const Surroundings around(shot.view(), shot.intrinsics, rod, to_eigen(pose));
  const PhotometricFit f = fit_photometric(shot.view(), shot.intrinsics, rod, inks, around, to_eigen(pose));
  EXPECT_TRUE(!f.valid || f.proof < 10) << f.proof;
}

TEST(PhotometricFit, IsInvalidWhereNothingIsSeen) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose truth = about_middle({}, {0, 0, 350});
  const Shot shot = shoot(marker, truth);
  // Behind the camera, and out of the picture.
  EXPECT_FALSE(fit(shot, rod, truth, about_middle({}, {0, 0, -350})).valid);
  EXPECT_FALSE(fit(shot, rod, truth, about_middle({}, {900, 0, 350})).valid);
}

}  // namespace
}  // namespace onestroke::test
