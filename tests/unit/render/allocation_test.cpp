// A frame allocates nothing once warm. Counts every `new` of the program, so it is one of its own.
#include "display/offscreen.h"
#include "golden/solids.h"
#include "golden/stage.h"
#include "render/renderer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

namespace {

thread_local bool counting = false;
thread_local int allocations = 0;

void* count_and_allocate(std::size_t size) {
  if (counting) ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Every `new` of this program, the driver's own libraries included, comes through here.
void* operator new(std::size_t size) {
  return count_and_allocate(size);
}
void* operator new[](std::size_t size) {
  return count_and_allocate(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace onestroke {
namespace {

TEST(Renderer, AllocatesNothingOnceWarm) {
  OffscreenDisplay display({.width = 320, .height = 240, .views = 1});
  Gpu gpu({.needs = display.needs()});
  display.attach(gpu);
  Renderer renderer(gpu);
  const golden::Chart chart(160, 120, PixelFormat::rgb8, 0.9);
  const auto ring = renderer.load(golden::torus(0.05F, 0.02F, {}));
  const std::array instances{
      ModelInstance{.model = ring, .world_graphics_from_model = golden::placed(0, 0, -0.4F, 0, 0)},
      ModelInstance{
          .model = ring, .world_graphics_from_model = golden::placed(0.1F, 0, -0.4F, 0, 0), .tint = {1, 1, 1, 0.5F}}};
  const std::array labels{Label{.text = "a label", .position_world = {0, 0, 400}}};
  const std::array lines{Line{.from_world = {0, 0, 400}, .to_world = {50, 0, 400}}};
  for (int i = 0; i < 12; ++i) {
    FrameInfo frame;
    display.begin(frame);
    counting = i >= 6;
    renderer.set_picture(chart.picture);
    const bool drawn = renderer.draw({.instances = instances, .lines = lines, .labels = labels}, frame);
    counting = false;
    ASSERT_TRUE(drawn) << renderer.failure();
    display.end(frame);
  }
  display.finish();
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace onestroke
