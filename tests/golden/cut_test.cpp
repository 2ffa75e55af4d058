// Faces of cuts that are filled: where they are, how deep, and how they look.
#include "golden/solids.h"
#include "golden/stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke::golden {
namespace {

const ModelMaterial blue{.base_color = {0.1F, 0.3F, 0.8F, 1}, .metallic = 0, .roughness = 0.6F};
const ModelMaterial green{.base_color = {0.15F, 0.6F, 0.3F, 1}, .metallic = 0, .roughness = 0.6F};
const Color lime{0.3F, 1, 0, 1};
const Tolerance tolerance{.level = 3, .pixels = 60};

/// Square to the line of sight of a view at the origin; keeps what is farther. Metres.
ClipPlane behind(float distance) {
  return {.a = 0, .b = 0, .c = -1, .d = -distance};
}

/// Of a view at the origin, pixels.
double focal(int width, double fov) {
  return width / 2.0 / std::tan(fov / 2);
}

/// Seen alone, without light from a camera.
FrameScene scene_of(std::span<const ModelInstance> instances, std::span<const Line> lines = {}) {
  return {
      .passthrough_distance = {}, .background = {0, 0, 0, 0}, .instances = instances, .lines = lines, .light = Light{}};
}

/// As things in these tests are coloured.
bool is_yellow(const std::uint8_t* c) {
  return c[0] > c[1] && c[1] > c[2];
}
bool is_lime(const std::uint8_t* c) {
  return c[1] > 1.2 * c[0] && c[0] > c[2];
}

template <typename Test>
int count(const Picture& picture, Test&& test) {
  int sum = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sum += test(picture.at(x, y));
  return sum;
}

class Cuts : public Stage {
 protected:
  /// The area of what has the colour of a cut, pixels, with the shares of those at edges.
  double yellow_area(const FrameScene& scene) {
    const Picture picture = draw(scene);
    const auto rgba = display_->read_back();
    double sum = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (is_yellow(picture.at(x, y)))
          sum += rgba[4 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) + 3] / 255.0;
    return sum;
  }

  ModelInstance cut(const Model& model, Matrix4 at, ClipPlane plane) {
    return {.model = renderer->load(model), .world_graphics_from_model = at, .clip_plane = plane, .fill_cut = true};
  }
  ModelInstance half_cube() { return cut(box({0.05F, 0.05F, 0.05F}, blue), placed(0, 0, -0.4F, 0, 0), behind(0.4F)); }
};

using CutsStereo = StereoStage;

TEST_F(Cuts, FillAsMuchAsTheSolidIsCut) {
  std::array cube{half_cube()};
  const double side = 0.1 / 0.4 * focal(width, fov);
  EXPECT_NEAR(yellow_area(scene_of(cube)) / (side * side), 1, 0.01);
  cube[0].world_graphics_from_model[0] *= -1;
  EXPECT_NEAR(yellow_area(scene_of(cube)) / (side * side), 1, 0.01) << "mirrored";

  // The hole of a ring stays open, though behind its face there are surfaces that are seen from within.
  const std::array ring{cut(torus(0.06F, 0.025F, blue), placed(0, 0, -0.4F, 0, 0), behind(0.4F))};
  const double annulus = 4 * std::numbers::pi * 0.06 * 0.025 * std::pow(focal(width, fov) / 0.4, 2);
  EXPECT_NEAR(yellow_area(scene_of(ring)) / annulus, 1, 0.01);

  const std::array pipe{
      cut(hollow(torus(0.06F, 0.025F, blue), torus(0.06F, 0.015F, blue)), placed(0, 0, -0.4F, 0, 0), behind(0.4F))};
  EXPECT_NEAR(yellow_area(scene_of(pipe)) / annulus, 10.0 / 25, 0.01);
}

TEST_F(Cuts, FillNothingWhereThereIsNoFaceToSee) {
  std::array instances{half_cube()};
  ASSERT_GT(yellow_area(scene_of(instances)), 1000);
  for (const ClipPlane& plane : {ClipPlane{0, 0, 1, 0.4F}, behind(0.3F), behind(0.5F)}) {
    instances[0].clip_plane = plane;
    EXPECT_EQ(yellow_area(scene_of(instances)), 0) << plane.d;
  }
  instances[0].clip_plane.reset();
  EXPECT_EQ(yellow_area(scene_of(instances)), 0);
}

TEST_F(Cuts, AreAsDeepAsTheirPlane) {
  const auto seen = [&](std::span<const ModelInstance> instances, double distance) {
    const std::array lines{
        Line{.from_world = {-30, 10, distance}, .to_world = {30, 10, distance}, .width_px = 3, .color = lime}};
    return count(draw(scene_of(instances, lines)), is_lime);
  };
  std::array instances{half_cube()};
  for (const float opacity : {1.0F, 0.5F}) {
    instances[0].tint.a = opacity;
    EXPECT_GT(seen(instances, 399.8), 150) << opacity;
    EXPECT_EQ(seen(instances, 400.2), 0) << opacity;
  }
  instances[0].occluder = true;
  EXPECT_GT(seen(instances, 399.8), 150);
  EXPECT_EQ(seen(instances, 400.2), 0);
  EXPECT_EQ(yellow_area(scene_of(instances)), 0);
}

TEST_F(Cuts, LookTheSameInAnyOrder) {
  std::array instances{cut(box({0.05F, 0.03F, 0.05F}, blue), placed(-0.02F, 0, -0.4F, 0.3F, 0.4F),
                           {.a = 0.3F, .b = -0.2F, .c = -0.93F, .d = -0.36F}),
                       cut(torus(0.05F, 0.02F, green), placed(0.02F, 0, -0.41F, 0.2F, 0.5F),
                           {.a = -0.4F, .b = -0.2F, .c = -0.89F, .d = -0.37F})};
  instances[1].cut_color = {0.3F, 0.1F, 0.5F, 1};
  const Picture one = draw(scene_of(instances));
  std::swap(instances[0], instances[1]);
  const auto result = compare(one, draw(scene_of(instances)), {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(Cuts, InOnePlaneHideEachOtherWithoutSpeckles) {
  const ClipPlane plane{.a = 0.3F, .b = -0.2F, .c = -0.93F, .d = -0.36F};
  std::array instances{cut(torus(0.03F, 0.01F, green), placed(0.01F, 0, -0.4F, 0.2F, 0.5F), plane),
                       cut(box({0.06F, 0.06F, 0.06F}, blue), placed(0, 0, -0.4F, 0.3F, 0.4F), plane)};
  instances[0].cut_color = {0.3F, 0.1F, 0.9F, 1};
  const double hidden = yellow_area(scene_of(instances)), alone = yellow_area(scene_of(std::span(instances).last(1)));
  EXPECT_GT(alone, 10000);
  EXPECT_EQ(hidden, alone);
}

TEST_F(Cuts, ShowTheInsideOfSolids) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const ClipPlane plane{.a = -0.5F, .b = -0.45F, .c = -0.74F, .d = -0.3F};
  const std::array instances{cut(box({0.04F, 0.05F, 0.04F}, blue), placed(-0.07F, 0, -0.4F, 0.3F, 0.5F), plane),
                             cut(torus(0.05F, 0.024F, green), placed(0.075F, 0, -0.4F, 0.6F, 0.3F), plane)};
  // A line goes into the face of the first.
  const std::array lines{Line{.from_world = {-40, -60, 310}, .to_world = {-80, 20, 430}, .width_px = 3}};
  expect_golden("cut_oblique", draw({.instances = instances, .lines = lines}), tolerance);
}

TEST_F(Cuts, ShowTheWallsOfWhatIsHollow) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const ClipPlane plane{.a = -0.35F, .b = -0.3F, .c = -0.89F, .d = -0.34F};
  const std::array instances{cut(hollow(box({0.045F, 0.045F, 0.045F}, blue), box({0.03F, 0.035F, 0.03F}, blue)),
                                 placed(-0.07F, 0, -0.4F, 0.3F, 0.5F), plane),
                             cut(hollow(torus(0.05F, 0.026F, green), torus(0.05F, 0.017F, green)),
                                 placed(0.08F, 0, -0.4F, 0.4F, 0.3F), plane)};
  expect_golden("cut_hollow", draw({.instances = instances}), tolerance);
}

TEST_F(Cuts, FadeWithTheirModel) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const ClipPlane plane{.a = -0.5F, .b = -0.45F, .c = -0.74F, .d = -0.3F};
  std::array instances{cut(hollow(box({0.045F, 0.045F, 0.045F}, blue), box({0.03F, 0.035F, 0.03F}, blue)),
                           placed(-0.07F, 0, -0.4F, 0.3F, 0.5F), plane),
                       cut(torus(0.05F, 0.024F, green), placed(0.075F, 0, -0.4F, 0.6F, 0.3F), plane)};
  for (auto& instance : instances) instance.tint.a = 0.6F;
  instances[1].cut_color = {0.35F, 0.25F, 0.75F, 1};
  expect_golden("cut_faded", draw({.instances = instances}), tolerance);
}

TEST_F(CutsStereo, AreHatchedAlikeInBothEyes) {
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const auto load = [&](const ModelMaterial& material) {
    return renderer->load(hollow(torus(0.045F, 0.024F, material), torus(0.045F, 0.014F, material)));
  };
  // Their planes stand alike in both models.
  std::array<ModelInstance, 2> instances;
  for (std::size_t i = 0; i < 2; ++i)
    instances[i] = {.model = load(i ? green : blue),
                    .world_graphics_from_model = placed(i ? 0.07F : -0.07F, 0, -0.4F, 0.5F, 0),
                    .clip_plane = ClipPlane{.a = -0.2F, .b = 0, .c = -0.98F, .d = i ? -0.378F : -0.406F},
                    .fill_cut = true};
  const Picture both = draw({.instances = instances});
  expect_golden("cut_stereo", both, {.level = 3, .pixels = 120});

  renderer = std::make_unique<Renderer>(*gpu, RendererOptions{.multiview = false});
  renderer->set_picture(chart.picture);
  instances[0].model = load(blue);
  instances[1].model = load(green);
  const auto result = compare(draw({.instances = instances}), both, {.level = 1});
  EXPECT_TRUE(result.same) << result.words;
}

}  // namespace
}  // namespace onestroke::golden
