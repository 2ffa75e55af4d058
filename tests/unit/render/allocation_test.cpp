// A frame allocates nothing once warm. Counts every `new` of the program, the driver's own libraries included, so it is
// one of its own.
#include "allocation/allocation_counter.h"
#include "display/offscreen.h"
#include "golden/solids.h"
#include "golden/stage.h"
#include "render/renderer.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

/// Of one view, or of two that see a pair of pictures.
class WarmRenderer : public testing::TestWithParam<int> {};

TEST_P(WarmRenderer, AllocatesNothing) {
  const int views = GetParam();
  OffscreenDisplay display({.width = views * 320, .height = 240, .views = views});
  Gpu gpu({.needs = display.needs()});
  display.attach(gpu);
  Renderer renderer(gpu);
  const golden::Chart chart(160, 120, PixelFormat::rgb8, 0.9);
  const auto ring = renderer.load(golden::torus(0.05F, 0.02F, {}));
  const std::array instances{
      ModelInstance{.model = ring, .world_graphics_from_model = golden::placed(0, 0, -0.4F, 0, 0)},
      ModelInstance{
          .model = ring, .world_graphics_from_model = golden::placed(0.1F, 0, -0.4F, 0, 0), .tint = {1, 1, 1, 0.5F}},
      ModelInstance{.model = ring,
                    .world_graphics_from_model = golden::placed(-0.1F, 0, -0.4F, 0, 0),
                    .clip_plane = ClipPlane{.a = 0, .b = 0, .c = -1, .d = -0.4F},
                    .fill_cut = true}};
  const std::array labels{Label{.text = "a label", .position_world = {0, 0, 400}}};
  const std::array lines{Line{.from_world = {0, 0, 400}, .to_world = {50, 0, 400}}};
  const std::array gauges{Gauge{.position_world = {0, 50, 400}, .progress = 0.5}};
  const std::array boxes{HudBox{.x = 5, .y = 50, .width = 10, .height = 20}};
  const FrameScene scene{.instances = instances, .lines = lines, .labels = labels, .gauges = gauges, .boxes = boxes};
  long allocations = 0;
  for (int i = 0; i < 12; ++i) {
    FrameInfo frame;
    display.begin(frame);
    const long before = test::allocations_of_this_thread();
    renderer.set_picture(chart.picture);
    if (views == 2) renderer.set_second_picture(chart.picture);
    const bool drawn = renderer.draw(scene, frame);
    if (i >= 6) allocations += test::allocations_of_this_thread() - before;
    ASSERT_TRUE(drawn) << renderer.failure();
    display.end(frame);
  }
  display.finish();
  EXPECT_EQ(allocations, 0);
}

INSTANTIATE_TEST_SUITE_P(Views, WarmRenderer, testing::Values(1, 2));

}  // namespace
}  // namespace onestroke
