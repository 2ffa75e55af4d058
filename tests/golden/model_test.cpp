// Models over the camera's picture.
#include "core/error.h"
#include "golden/solids.h"
#include "golden/stage.h"

#include <cmath>
#include <numbers>

namespace onestroke::golden {
namespace {

class Models : public Stage {
 protected:
  Models() { renderer->set_picture(chart.picture); }

  ModelMaterial brass() const { return {.base_color = {0.9F, 0.6F, 0.25F, 1}, .metallic = 0.9F, .roughness = 0.35F}; }
  ModelMaterial paint(float r, float g, float b) const {
    return {.base_color = {r, g, b, 1}, .metallic = 0, .roughness = 0.55F};
  }

  const Chart chart{width, height, PixelFormat::rgb8, fov};
  const Tolerance tolerance{.level = 3, .pixels = 60};
};

TEST_F(Models, AreLit) {
  ModelMaterial material = brass();
  material.base_color_texture = 0;
  material.normal_texture = 1;
  Model model = torus(0.07F, 0.028F, material);
  model.images = {checks(128, 4), bumps(256, 8)};
  const std::array instances{
      ModelInstance{.model = renderer->load(model), .world_graphics_from_model = placed(0, 0, -0.35F, -0.7F, 0.3F)}};
  expect_golden("model_lit", draw({.instances = instances}), tolerance);
}

TEST_F(Models, HideEachOtherByDepthAndNotByOrder) {
  // A far box given last, and a ring through a box, which no order could get right.
  const auto ring = renderer->load(torus(0.05F, 0.015F, paint(0.8F, 0.2F, 0.15F)));
  const auto block = renderer->load(box({0.03F, 0.03F, 0.03F}, paint(0.2F, 0.45F, 0.8F)));
  const std::array instances{
      ModelInstance{.model = ring, .world_graphics_from_model = placed(-0.03F, 0, -0.4F, 0.9F, 0.2F)},
      ModelInstance{.model = block, .world_graphics_from_model = placed(0.02F, 0, -0.4F, 0.5F, 0.6F)},
      ModelInstance{.model = block, .world_graphics_from_model = placed(-0.05F, 0.02F, -0.6F, 0.2F, 0.4F, 2)}};
  expect_golden("models_depth", draw({.instances = instances}), tolerance);
}

TEST_F(Models, AreHiddenByOccluders) {
  const auto ring = renderer->load(torus(0.07F, 0.025F, brass()));
  const auto stick = renderer->load(box({0.012F, 0.15F, 0.012F}, paint(1, 1, 1)));
  const std::array instances{
      ModelInstance{.model = ring, .world_graphics_from_model = placed(0, 0, -0.4F, -0.4F, 0.2F)},
      ModelInstance{.model = stick, .world_graphics_from_model = placed(0.05F, 0, -0.34F, 0, 0.5F), .occluder = true},
      ModelInstance{.model = stick, .world_graphics_from_model = placed(-0.06F, 0, -0.46F, 0, 0.5F), .occluder = true}};
  expect_golden("model_occluder", draw({.instances = instances}), tolerance);
}

TEST_F(Models, LetTheWorldThroughButNotTheirOwnBack) {
  ModelMaterial glass = paint(0.3F, 0.8F, 0.9F);
  glass.base_color[3] = 0.45F;
  glass.alpha_mode = ModelMaterial::AlphaMode::blend;
  const auto solid = renderer->load(box({0.03F, 0.03F, 0.03F}, paint(0.8F, 0.25F, 0.15F)));
  const auto pane = renderer->load(sheet(0.05F, glass));
  const auto ring = renderer->load(torus(0.05F, 0.02F, brass()));
  // Panes given front to back, so that the order has to be found; a faded ring on the right.
  const std::array instances{
      ModelInstance{.model = pane, .world_graphics_from_model = placed(-0.05F, -0.02F, -0.3F, 0, 0)},
      ModelInstance{.model = pane, .world_graphics_from_model = placed(-0.09F, 0.02F, -0.36F, 0, 0)},
      ModelInstance{.model = solid, .world_graphics_from_model = placed(-0.08F, 0, -0.45F, 0.5F, 0.6F)},
      ModelInstance{
          .model = ring, .world_graphics_from_model = placed(0.08F, 0, -0.38F, 1.1F, 0.3F), .tint = {1, 1, 1, 0.5F}}};
  expect_golden("model_blend", draw({.instances = instances}), tolerance);
}

TEST_F(Models, AreCutByAPlane) {
  const auto ring = renderer->load(torus(0.07F, 0.028F, paint(0.85F, 0.8F, 0.7F)));
  const std::array instances{ModelInstance{.model = ring,
                                           .world_graphics_from_model = placed(0, 0, -0.38F, -0.5F, 0),
                                           .clip_plane = ClipPlane{.a = -0.4F, .b = 0.5F, .c = -0.77F, .d = -0.29F}}};
  expect_golden("model_clip", draw({.instances = instances}), tolerance);
}

TEST_F(Models, HaveTheColorsOfTheirVertices) {
  Model ring = torus(0.06F, 0.028F, paint(1, 1, 1));
  for (ModelVertex& v : ring.vertices)
    for (std::size_t i = 0; i < 3; ++i)
      v.color[i] = 0.5F + 0.45F * std::sin(60 * v.position[i] + static_cast<float>(i));
  const std::array instances{
      ModelInstance{.model = renderer->load(ring), .world_graphics_from_model = placed(0, 0, -0.35F, -0.6F, 0.3F)}};
  expect_golden("model_vertex_colors", draw({.instances = instances}), tolerance);
}

TEST_F(Models, AreNotThereWhereTheirAlphaIsBelowTheCutoff) {
  ModelMaterial grille = paint(0.9F, 0.75F, 0.3F);
  grille.base_color_texture = 0;
  grille.alpha_mode = ModelMaterial::AlphaMode::mask;
  Model fence = box({0.05F, 0.05F, 0.05F}, grille);
  fence.images = {checks(128, 6)};
  for (std::size_t i = 0; i < fence.images[0].rgba.size(); i += 4)
    if (fence.images[0].rgba[i] < 200) fence.images[0].rgba[i + 3] = 80;
  const auto ball = renderer->load(torus(0.012F, 0.012F, paint(0.8F, 0.15F, 0.15F)));
  // Something stands within, to be seen through the holes.
  const std::array instances{
      ModelInstance{.model = renderer->load(fence), .world_graphics_from_model = placed(0, 0, -0.4F, 0.4F, 0.6F)},
      ModelInstance{.model = ball, .world_graphics_from_model = placed(0, 0, -0.4F, 0, 0)}};
  expect_golden("model_alpha_mask", draw({.instances = instances}), tolerance);
}

TEST_F(Models, ShowTheirBacksWhereTheyHaveTwoSides) {
  ModelMaterial both = paint(0.3F, 0.6F, 0.85F);
  both.double_sided = true;
  const auto one_sided = renderer->load(sheet(0.035F, paint(0.85F, 0.5F, 0.2F)));
  const auto two_sided = renderer->load(sheet(0.035F, both));
  // From the left: both from before, both from behind, where only one is left.
  const float behind = std::numbers::pi_v<float> + 0.5F;
  const std::array instances{
      ModelInstance{.model = one_sided, .world_graphics_from_model = placed(-0.07F, 0.05F, -0.4F, 0, 0.5F)},
      ModelInstance{.model = two_sided, .world_graphics_from_model = placed(-0.07F, -0.05F, -0.4F, 0, 0.5F)},
      ModelInstance{.model = one_sided, .world_graphics_from_model = placed(0.07F, 0.05F, -0.4F, 0, behind)},
      ModelInstance{.model = two_sided, .world_graphics_from_model = placed(0.07F, -0.05F, -0.4F, 0, behind)}};
  expect_golden("model_double_sided", draw({.instances = instances}), tolerance);
}

TEST_F(Models, KeepTheirOutsideWhenMirrored) {
  // A mirrored and a plain torus are the same body, so light must find them alike.
  const auto ring = renderer->load(torus(0.05F, 0.02F, paint(0.8F, 0.8F, 0.8F)));
  const std::array plain{ModelInstance{.model = ring, .world_graphics_from_model = placed(0, 0, -0.35F, 0, 0)}};
  auto mirrored = plain;
  mirrored[0].world_graphics_from_model[0] *= -1;
  const auto result = compare(draw({.instances = plain}), draw({.instances = mirrored}), {.level = 4, .pixels = 200});
  EXPECT_TRUE(result.same) << result.words;
}

TEST_F(Models, DisappearWhenUnloaded) {
  const auto block = renderer->load(box({0.03F, 0.03F, 0.03F}, paint(0.2F, 0.45F, 0.8F)));
  const std::array instances{ModelInstance{.model = block, .world_graphics_from_model = placed(0, 0, -0.4F, 0, 0)}};
  const Picture empty = draw({}), with = draw({.instances = instances});
  EXPECT_FALSE(compare(empty, with, {}).same);
  renderer->unload(block);
  EXPECT_TRUE(compare(empty, draw({.instances = instances}), {.level = 0}).same);
  const auto again = renderer->load(box({0.03F, 0.03F, 0.03F}, paint(0.2F, 0.45F, 0.8F)));
  EXPECT_EQ(again, block);
  EXPECT_TRUE(compare(with, draw({.instances = instances}), {.level = 0}).same);
}

TEST_F(Models, SayWhatIsWrongWithThem) {
  Model model = box({1, 1, 1}, paint(1, 1, 1));
  model.indices[5] = 1000;
  EXPECT_THROW(renderer->load(model), Error);
  model = box({1, 1, 1}, paint(1, 1, 1));
  model.materials[0].normal_texture = 2;
  EXPECT_THROW(renderer->load(model), Error);
  model = box({1, 1, 1}, paint(1, 1, 1));
  model.parts[0].index_count += 3;
  EXPECT_THROW(renderer->load(model), Error);
}

}  // namespace
}  // namespace onestroke::golden
