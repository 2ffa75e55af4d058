// The renderer's promises that no picture shows.
#include "render/renderer.h"

#include "core/error.h"
#include "display/offscreen.h"
#include "golden/solids.h"
#include "golden/stage.h"

#include <gmock/gmock.h>
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

TEST(Renderer, RefusesPicturesThatAreNotSound) {
  Gpu gpu(GpuOptions{});
  Renderer renderer(gpu);
  golden::Chart chart(64, 48, PixelFormat::rgb8, 0.9);
  Picture broken = chart.picture;
  broken.planes[0] = nullptr;
  EXPECT_THROW(renderer.set_picture(broken), Error);
  broken = chart.picture;
  broken.strides[0] = 100;
  EXPECT_THROW(renderer.set_picture(broken), Error);
  broken = chart.picture;
  broken.intrinsics = {};
  EXPECT_THROW(renderer.set_picture(broken), Error);
  broken = chart.picture;
  broken.width = 0;
  EXPECT_THROW(renderer.set_picture(broken), Error);
  EXPECT_NO_THROW(renderer.set_picture(chart.picture));
}

TEST(Gpu, IsChosenByNumberOrByName) {
  const std::string name = Gpu(GpuOptions{.gpu = "0"}).name();
  EXPECT_EQ(Gpu(GpuOptions{.gpu = name.substr(0, 4)}).name(), name);
}

TEST(Gpu, SaysWhichThereAreWhereTheNamedOneIsMissing) {
  try {
    Gpu gpu(GpuOptions{.gpu = "no such thing"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("no GPU is called \"no such thing\": there are 0 "));
  }
}

TEST(Gpu, NamesTheExtensionThatIsMissing) {
  try {
    Gpu gpu(GpuOptions{.needs = {.instance_extensions = {"VK_ONESTROKE_nothing"}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("VK_ONESTROKE_nothing"));
  }
  try {
    Gpu gpu(GpuOptions{.needs = {.device_extensions = {"VK_ONESTROKE_device"}}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("VK_ONESTROKE_device"));
  }
}

}  // namespace
}  // namespace onestroke
