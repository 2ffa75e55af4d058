// Models that are made ready on another thread, and models in levels of detail.
#include "core/error.h"
#include "golden/solids.h"
#include "golden/stage.h"
#include "scene/mesh_levels.h"

#include <atomic>
#include <thread>

namespace onestroke::golden {
namespace {

constexpr Tolerance same{.level = 0};

class ModelUpload : public Stage {
 protected:
  Model textured() const {
    ModelMaterial material{.base_color = {0.9F, 0.6F, 0.25F, 1}, .metallic = 0.4F, .roughness = 0.35F};
    material.base_color_texture = 0;
    Model model = torus(0.07F, 0.028F, material);
    model.images = {checks(128, 4)};
    return model;
  }
  Picture drawn(ModelHandle model, float depth = -0.35F, float opacity = 1) {
    const std::array instances{ModelInstance{
        .model = model, .world_graphics_from_model = placed(0, 0, depth, -0.7F, 0.3F), .tint = {1, 1, 1, opacity}}};
    return draw({.instances = instances});
  }
};

TEST_F(ModelUpload, ModelsOfOtherThreadsLookAsThoseOfThisOne) {
  const Picture expected = drawn(renderer->load(textured()));
  std::array<std::shared_ptr<PreparedModel>, 4> prepared;
  std::atomic<int> ready{0};
  std::vector<std::jthread> threads;
  for (auto& p : prepared)
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) p = renderer->prepare(textured());
      ++ready;
    });
  // Frames go on meanwhile.
  const Picture empty = draw({});
  while (ready < 4) EXPECT_TRUE(compare(empty, draw({}), same).same);
  threads.clear();
  for (auto& p : prepared) EXPECT_TRUE(compare(expected, drawn(renderer->adopt(std::move(p))), same).same);
}

TEST_F(ModelUpload, WhatIsNotTakenInOrUnloadedAtOnceLeavesNothingBehind) {
  const auto unused = renderer->prepare(textured());
  const ModelHandle gone = renderer->load(textured());
  renderer->unload(gone);
  const Picture empty = draw({});
  EXPECT_TRUE(compare(empty, drawn(gone), same).same);
}

TEST_F(ModelUpload, LevelsMustFitTheModel) {
  Model model = textured();
  add_levels(model);
  ASSERT_FALSE(model.levels.empty());
  Model broken = model;
  broken.levels[0].parts.clear();
  EXPECT_THROW(renderer->load(broken), Error);
  broken = model;
  broken.levels[0].parts[0].index_count += 3'000'000;
  EXPECT_THROW(renderer->load(broken), Error);
}

// A level that is nothing to see shows which one is drawn.
TEST_F(ModelUpload, TheLevelIsThatOfTheDistanceAndOfTheNearestView) {
  Model model = torus(0.02F, 0.008F, {});
  ModelPart nothing = model.parts[0];
  nothing.index_count = 0;
  model.levels = {{.error = 0.0005F, .parts = {nothing}}};
  const ModelHandle ring = renderer->load(model);
  const Picture empty = draw({});
  EXPECT_FALSE(compare(empty, drawn(ring, -0.3F), same).same) << "half a millimetre is seen at 300 mm";
  EXPECT_TRUE(compare(empty, drawn(ring, -0.9F), same).same) << "and not at 900";
  for (const float opacity : {1.0F, 0.5F}) EXPECT_TRUE(compare(empty, drawn(ring, -0.9F, opacity), same).same);
  // The scale counts: the same size on the screen from nearer by.
  const std::array large{ModelInstance{.model = ring, .world_graphics_from_model = placed(0, 0, -0.9F, 0, 0, 3)}};
  EXPECT_FALSE(compare(empty, draw({.instances = large}), same).same);
}

TEST_F(ModelUpload, NobodySeesWhichLevelIsDrawn) {
  Model model = torus(0.07F, 0.028F, {.base_color = {0.8F, 0.5F, 0.3F, 1}, .metallic = 0, .roughness = 0.6F});
  const ModelHandle full = renderer->load(model);
  add_levels(model);
  ASSERT_FALSE(model.levels.empty());
  const ModelHandle levelled = renderer->load(model);
  for (const float depth : {-0.3F, -0.6F, -1.5F})
    for (const float opacity : {1.0F, 0.5F}) {
      const auto result =
          compare(drawn(full, depth, opacity), drawn(levelled, depth, opacity), {.level = 16, .pixels = 60});
      EXPECT_TRUE(result.same) << "at " << depth << " m: " << result.words;
    }
}

}  // namespace
}  // namespace onestroke::golden
