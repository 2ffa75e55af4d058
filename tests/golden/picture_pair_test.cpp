// Two cameras' pictures, each seen by its own eye.
#include "golden/solids.h"
#include "golden/stage.h"

#include <cmath>

namespace onestroke::golden {
namespace {

/// The left camera's picture as charts are; the right one's with red and blue exchanged, through another lens, from
/// another place.
class PicturePair : public StereoStage {
 protected:
  PicturePair()
      : left(width, height, PixelFormat::rgb8, fov), right(right_width, right_height, PixelFormat::rgb8, 0.8) {
    for (int y = 0; y < right_height; ++y)
      for (int x = 0; x < right_width; ++x) std::swap(at(x, y)[0], at(x, y)[2]);
    left.picture.T_world_camera = {exp_so3({0.02, 0, 0}), {-30, 4, 10}};
    right.picture.T_world_camera = left.picture.T_world_camera * Pose{exp_so3({0, -0.05, 0.03}), {64, 0, 0}};
  }

  std::uint8_t* at(int x, int y) {
    return right.bytes.data() + right.picture.strides[0] * static_cast<std::size_t>(y) +
           3 * static_cast<std::size_t>(x);
  }
  void show_pair() {
    renderer->set_picture(left.picture);
    renderer->set_second_picture(right.picture);
  }
  /// An eye that sees what a camera sees.
  static View eye_of(const onestroke::Picture& p) {
    return {.T_world_view = p.T_world_camera,
            .fov = fov_to_fit(p.intrinsics, p.width, p.height, {0, 0, width, height}),
            .viewport = {0, 0, width, height}};
  }
  std::array<View, 2> eyes() const { return {eye_of(left.picture), eye_of(right.picture)}; }
  /// The eyes a little beside their cameras, as a head has them.
  std::array<View, 2> eyes_beside() const {
    auto views = eyes();
    for (View& view : views) view.T_world_view = view.T_world_view * Pose{exp_so3({0.02, 0.03, 0}), {4, 30, -60}};
    return views;
  }
  static Picture half_of(const Picture& both, int eye) {
    Picture half{width, height, {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) half.rgb.push_back(both.at(eye * width + x, y)[c]);
    return half;
  }
  void draw_apart() {
    renderer.reset();
    renderer = std::make_unique<Renderer>(*gpu, RendererOptions{.multiview = false});
    show_pair();
  }

  static constexpr int right_width = 400, right_height = 300;
  Chart left, right;
  const std::array<DepthSegment, 2> stick{DepthSegment{{-60, 50, 420}, {0, -20, 380}},
                                          DepthSegment{{0, -20, 380}, {70, 30, 400}}};
};

Picture as_shown(const Chart& chart) {
  const auto& p = chart.picture;
  Picture shown{p.width, p.height, {}};
  for (int y = 0; y < p.height; ++y) {
    const auto* row = p.planes[0] + p.strides[0] * static_cast<std::size_t>(y);
    shown.rgb.insert(shown.rgb.end(), row, row + 3 * p.width);
  }
  return shown;
}

TEST_F(PicturePair, EachEyeSeesItsOwnPixelForPixel) {
  const Chart other(width, height, PixelFormat::gray8, fov);
  onestroke::Picture second = other.picture;
  second.T_world_camera = right.picture.T_world_camera;
  renderer->set_picture(left.picture);
  renderer->set_second_picture(second);
  const std::array views{eye_of(left.picture), eye_of(second)};
  const Picture drawn = draw({.passthrough_segments = stick}, views);
  const auto of_left = compare(as_shown(left), half_of(drawn, 0), {.level = 1});
  EXPECT_TRUE(of_left.same) << of_left.words;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      ASSERT_NEAR(drawn.at(width + x, y)[1],
                  second.planes[0][second.strides[0] * static_cast<std::size_t>(y) + static_cast<std::size_t>(x)], 1)
          << x << ", " << y;
}

TEST_F(PicturePair, EachEyeSeesItsOwnThroughItsOwnLens) {
  right.picture.intrinsics.distortion = {-0.25, 0.08, 0.001, -0.002, 0};
  const ModelInstance ring{.model = renderer->load(torus(0.05F, 0.02F, {.base_color = {0.3F, 0.5F, 0.8F, 1}})),
                           .world_graphics_from_model = placed(0.02F, 0, -0.45F, -0.3F, 0.4F)};
  show_pair();
  const FrameScene scene{.passthrough_segments = stick, .instances = {&ring, 1}};
  expect_golden("picture_pair", draw(scene, eyes_beside()), {.level = 3, .pixels = 60});
}

TEST_F(PicturePair, IsTheSameInTwoPasses) {
  right.picture.intrinsics.distortion = {-0.25, 0.08, 0.001, -0.002, 0};
  show_pair();
  const FrameScene scene{.passthrough_segments = stick};
  const Picture together = draw(scene, eyes_beside());
  draw_apart();
  const auto result = compare(together, draw(scene, eyes_beside()), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(PicturePair, IsInCellsForBothWhereOneHasAny) {
  // Behind the right camera, so that its picture is one cell by itself.
  const std::array<DepthSegment, 1> aside{DepthSegment{{-200, 0, 22}, {-260, 0, 24}}};
  left.picture.T_world_camera = {};
  right.picture.T_world_camera = {exp_so3({0, 1.2, 0}), {64, 0, 0}};
  show_pair();
  const FrameScene scene{.passthrough_segments = aside};
  const Picture together = draw(scene, eyes_beside());
  draw_apart();
  const auto result = compare(together, draw(scene, eyes_beside()), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(PicturePair, TheNextPictureMayComeAlone) {
  renderer->set_picture(left.picture);
  const auto views = eyes_beside();
  const Picture alone = draw({}, views);
  show_pair();
  EXPECT_FALSE(compare(alone, draw({}, views), {.level = 1}).same);
  renderer->set_picture(left.picture);
  const auto result = compare(alone, draw({}, views), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
  renderer->clear_picture();
  const Picture dark = draw({}, views);
  EXPECT_LT(*std::max_element(dark.rgb.begin(), dark.rgb.end()), 40);
}

TEST_F(PicturePair, EachPictureHasItsOwnFingers) {
  // A finger of skin in the right picture alone, over a stick that the left one shows uncovered.
  for (int y = 120; y < right_height; ++y)
    for (int x = 180; x < 220; ++x)
      for (int c = 0; c < 3; ++c) at(x, y)[c] = static_cast<std::uint8_t>((c == 0 ? 220 : c == 1 ? 165 : 140) - y / 8);
  std::vector<CoveredCell> covered;
  const Intrinsics& k = right.picture.intrinsics;
  for (double u = 190; u <= 212; u += 7)
    covered.push_back({{(u - k.cx) / k.fx * 400, (160 - k.cy) / k.fy * 400, 400}, 1});
  const ModelInstance ring{.model = renderer->load(torus(0.05F, 0.02F, {.base_color = {0.3F, 0.5F, 0.8F, 1}})),
                           .world_graphics_from_model = placed(0, 0, -0.42F, -0.3F, 0)};
  renderer->set_picture(left.picture);
  renderer->set_second_picture(right.picture, covered);
  const FrameScene scene{.passthrough_segments = stick, .instances = {&ring, 1}};
  FrameScene without = scene;
  without.fingers = false;
  const Picture drawn = draw(scene, eyes()), plain = draw(without, eyes());
  EXPECT_TRUE(compare(half_of(plain, 0), half_of(drawn, 0), {.level = 1}).same);
  EXPECT_FALSE(compare(half_of(plain, 1), half_of(drawn, 1), {.level = 1}).same);
  expect_golden("picture_pair_fingers", drawn, {.level = 3, .pixels = 60});
}

using OneView = Stage;

TEST_F(OneView, ShowsTheFirstOfAPair) {
  const Chart left(width, height, PixelFormat::rgb8, fov), right(width, height, PixelFormat::gray8, fov);
  renderer->set_picture(left.picture);
  renderer->set_second_picture(right.picture);
  const auto result = compare(as_shown(left), draw({}), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

}  // namespace
}  // namespace onestroke::golden
