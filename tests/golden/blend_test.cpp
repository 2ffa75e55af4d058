// Output for displays that blend by themselves: premultiplied colour, and the opacity that goes with it.
#include "golden/solids.h"
#include "golden/stage.h"

#include <cmath>

namespace onestroke::golden {
namespace {

double linear(int level) {
  const double c = level / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

class BlendedOutput : public Stage {
 protected:
  static constexpr Color nothing{0, 0, 0, 0};

  Picture opacity() {
    const auto rgba = display_->read_back();
    Picture p{width, height, {}};
    for (std::size_t i = 3; i < rgba.size(); i += 4) p.rgb.insert(p.rgb.end(), 3, rgba[i]);
    return p;
  }

  FrameScene scene() {
    instances[0] = {
        .model = renderer->load(torus(0.045F, 0.018F, {.base_color = {0.8F, 0.3F, 0.2F, 1}, .metallic = 0})),
        .world_graphics_from_model = placed(-0.07F, 0, -0.4F, -0.6F, 0.3F)};
    instances[1] = {.model = instances[0].model,
                    .world_graphics_from_model = placed(0.07F, 0, -0.4F, -0.6F, -0.3F),
                    .tint = {1, 1, 1, 0.5F}};
    instances[2] = {.model = renderer->load(box({0.006F, 0.1F, 0.006F}, {})),
                    .world_graphics_from_model = placed(-0.06F, 0, -0.33F, 0, 0.4F),
                    .occluder = true};
    return {.passthrough_distance = {}, .background = nothing, .instances = instances, .labels = labels};
  }

  std::array<ModelInstance, 3> instances;
  std::array<Label, 1> labels{Label{.text = "alpha", .position_world = {0, -75, 400}}};
};

TEST_F(BlendedOutput, IsPremultipliedAndAsOpaqueAsWhatIsThere) {
  // The camera's picture is for the tracker here and must not be seen.
  const Chart chart(width, height, PixelFormat::rgb8, fov);
  renderer->set_picture(chart.picture);
  const Picture color = draw(scene()), alpha = opacity();
  int clear = 0, solid = 0, half = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int a = alpha.at(x, y)[0];
      clear += a == 0;
      solid += a == 255;
      half += a > 120 && a < 136;
      // Premultiplied light is never more than its opacity.
      for (int c = 0; c < 3; ++c) ASSERT_LE(linear(color.at(x, y)[c]), a / 255.0 + 0.01) << x << " " << y;
    }
  EXPECT_GT(clear, width * height / 2);
  EXPECT_GT(solid, 5000);
  EXPECT_GT(half, 5000);
  // Where the stick hides the model, what is behind the display shows through.
  EXPECT_EQ(alpha.at(width / 2 - 70, height / 2)[0], 0);
  expect_golden("output_premultiplied", color, {.level = 3, .pixels = 60});
  expect_golden("output_opacity", alpha, {.level = 3, .pixels = 60});
}

TEST_F(BlendedOutput, AddsNothingWhereThereIsNothing) {
  // An additive display shows the same colours and takes no notice of the opacity.
  const Picture color = draw(scene()), alpha = opacity();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (alpha.at(x, y)[0] > 0) continue;
      for (int c = 0; c < 3; ++c) ASSERT_EQ(color.at(x, y)[c], 0) << x << " " << y;
    }
}

}  // namespace
}  // namespace onestroke::golden
