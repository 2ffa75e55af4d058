// Models over the camera's picture.
#include "golden/solids.h"
#include "golden/stage.h"

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

}  // namespace
}  // namespace onestroke::golden
