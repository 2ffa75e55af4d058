// The render loop allocates nothing once warm. Counts every `new` of the loop's thread, so it is a program of its own.
#include "app/show.h"
#include "camera/open_camera.h"
#include "display/offscreen.h"

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

const std::filesystem::path assets = ONESTROKE_SOURCE_DIR "/assets";

/// The renderer keeps room for as many letters as it has ever drawn; a long text now leaves none to be made later, when
/// a number gets a digit more.
void make_room_for_words(Display& display, Renderer& renderer) {
  const std::string words(1500, 'm');
  const HudText text{.text = words};
  for (int i = 0; i < 3; ++i) {
    FrameInfo frame;
    display.begin(frame);
    ASSERT_TRUE(renderer.draw({.hud = {&text, 1}}, frame));
    display.end(frame);
  }
}

TEST(Show, AllocatesNothingOnceWarm) {
  const Catalog catalog = load_catalog(assets / "catalog.json");
  // A stick in front of the camera from the first picture on, with its model and its label.
  const auto camera = open_camera({.spec = "synthetic:script=turn_y,step_deg=2,width=640,height=480,fov_deg=35",
                                   .fov_rad = {},
                                   .calibration = {},
                                   .readout = {},
                                   .catalog = &catalog});
  {
    OffscreenDisplay display({.width = 320, .height = 240});
    Gpu gpu({.needs = display.needs()});
    display.attach(gpu);
    Renderer renderer(gpu);
    const ModelShelf shelf(catalog, assets, renderer);
    make_room_for_words(display, renderer);
    Tracker tracker(catalog);
    TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::every);
    Show show({display, renderer, tracking, shelf}, FrameFeed::Pace::each, PictureTime::exposure);
    std::size_t shown = 0;
    show.run({.pictures = 40}, [&](std::size_t pictures) {
      shown = pictures;
      counting = pictures >= 20;
    });
    counting = false;
    EXPECT_EQ(shown, 40u);
  }
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace onestroke
