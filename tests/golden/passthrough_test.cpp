// What the camera sees, seen from where it stood and from elsewhere.
#include "golden/stage.h"

#include <cmath>

namespace onestroke::golden {
namespace {

using Passthrough = Stage;
using PassthroughStereo = StereoStage;

Picture as_shown(const Chart& chart) {
  const auto& p = chart.picture;
  Picture shown{p.width, p.height, {}};
  const std::size_t channels = p.format == PixelFormat::rgb8 ? 3 : 1;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const auto* from =
          p.planes[0] + p.strides[0] * static_cast<std::size_t>(y) + channels * static_cast<std::size_t>(x);
      for (std::size_t c = 0; c < 3; ++c) shown.rgb.push_back(from[channels == 3 ? c : 0]);
    }
  return shown;
}

TEST_F(Passthrough, ShowsThePictureItselfFromTheCamera) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const Picture drawn = draw({});
  const auto result = compare(as_shown(chart), drawn, {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
  expect_golden("passthrough_identity", drawn, {.level = 1});
}

TEST_F(Passthrough, ShowsGreyPictures) {
  const Chart chart(width, height, PixelFormat::gray8, fov);
  renderer->set_picture(chart.picture);
  const auto result = compare(as_shown(chart), draw({}), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(Passthrough, ShowsThePictureItselfWhereverTheCameraStood) {
  Chart chart(width, height, PixelFormat::rgb8, fov);
  chart.picture.T_world_camera = {exp_so3({0.3, -0.7, 0.2}), {120, -450, 900}};
  renderer->set_picture(chart.picture);
  View view{.T_world_view = chart.picture.T_world_camera,
            .fov = fov_of(chart.picture.intrinsics, width, height),
            .viewport = {0, 0, width, height}};
  const auto result = compare(as_shown(chart), draw({}, {&view, 1}), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(Passthrough, TakesPicturesOfAnotherSizeAndBack) {
  const Chart small(192, 144, PixelFormat::rgb8, fov), full(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(full.picture);
  draw({});
  renderer->set_picture(small.picture);
  draw({});
  renderer->set_picture(full.picture);
  const auto result = compare(as_shown(full), draw({}), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(Passthrough, StandsAtItsDistanceWhenSeenFromBeside) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  View view{.T_world_view = {exp_so3({0.05, 0.25, 0.1}), {-150, 30, -80}},
            .fov = fov_of(chart.picture.intrinsics, width, height),
            .viewport = {0, 0, width, height}};
  expect_golden("passthrough_offset", draw({.passthrough_distance = 400}, {&view, 1}), {.level = 2, .pixels = 30});
}

TEST_F(Passthrough, ShiftsByTheParallaxOfItsDistance) {
  // Twice as far away it moves half as many pixels: f * 50 mm / distance.
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const double f = chart.picture.intrinsics.fx;
  const double distance = f * 50 / 24;  // 24 pixels
  View view{.T_world_view = {{}, {50, 0, 0}},
            .fov = fov_of(chart.picture.intrinsics, width, height),
            .viewport = {0, 0, width, height}};
  for (const int shift : {24, 12}) {
    const Picture drawn = draw({.passthrough_distance = distance * 24 / shift}, {&view, 1});
    const Picture whole = as_shown(chart);
    int worst = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x + shift < width; ++x)
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(drawn.at(x, y)[c] - whole.at(x + shift, y)[c]));
    EXPECT_LE(worst, 1) << shift;
  }
}

TEST_F(Passthrough, IsDarkWhereThePictureEnds) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  View behind{.T_world_view = {exp_so3({0, 3.14159265, 0}), {}},
              .fov = fov_of(chart.picture.intrinsics, width, height),
              .viewport = {0, 0, width, height}};
  const Picture drawn = draw({}, {&behind, 1});
  EXPECT_LT(*std::max_element(drawn.rgb.begin(), drawn.rgb.end()), 40);
}

TEST_F(Passthrough, FollowsTheLens) {
  Chart chart(width, height, PixelFormat::rgb8, fov);
  chart.picture.intrinsics.distortion = {-0.28, 0.09, 0.001, -0.002, 0};
  renderer->set_picture(chart.picture);
  expect_golden("passthrough_lens", draw({}), {.level = 2, .pixels = 30});
}

TEST_F(PassthroughStereo, GivesEachEyeItsOwnParallax) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  expect_golden("passthrough_stereo", draw({.passthrough_distance = 450}), {.level = 2, .pixels = 30});
}

}  // namespace
}  // namespace onestroke::golden
