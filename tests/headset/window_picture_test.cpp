// What the wearer sees, as the compositor's window shows it.
#include "desktop/x_server.h"
#include "golden/comparator.h"
#include "headset/headset.h"

#include <cstdlib>
#include <filesystem>
#include <thread>

namespace onestroke {
namespace {

using StillWindow = Headset;

/// As a golden picture, whoever drew it: the compositor's Mesa is not the one that draws the others, and changes.
void expect_golden(const std::string& name, const golden::Picture& seen, golden::Tolerance tolerance) {
  const std::filesystem::path file = HEADSET_PICTURES "/" + name + ".png";
  const char* bless = std::getenv("ONESTROKE_BLESS");
  if (bless && (bless == name || bless == std::string("all"))) golden::write_png(file, seen);
  const golden::Comparison comparison = golden::compare(golden::read_png(file), seen, tolerance);
  if (comparison.same) return;
  const std::filesystem::path folder = HEADSET_FAILURES;
  std::filesystem::create_directories(folder);
  golden::write_png(folder / (name + ".png"), seen);
  golden::write_png(folder / (name + "_difference.png"), comparison.difference);
  ADD_FAILURE() << name << ": " << comparison.words << "; see " << folder.string() << ", and if it is right run with "
                << "ONESTROKE_BLESS=" << name;
}

TEST_F(StillWindow, ShowsPictureModelAndWords) {
  const golden::Chart chart(640, 480, PixelFormat::rgb8, 1.0);
  renderer->set_picture(chart.picture);
  const std::array instances{
      ModelInstance{.model = ring, .world_graphics_from_model = golden::placed(0.02F, -0.02F, -0.4F, 0.7F, 0.4F)}};
  const std::array labels{Label{.text = "ring", .position_world = {20, -50, 400}, .height_px = 22, .on_top = true}};
  const std::array lines{Line{.from_world = {-80, 60, 420}, .to_world = {80, 60, 380}, .width_px = 3}};
  const std::array words{HudText{.text = "Side by side", .x = 10, .y = 10, .height_px = 20}};
  FrameScene scene{.instances = instances, .lines = lines, .labels = labels, .hud = words, .grain = false};
  scene.hud_plate = HudPlate{.distance = 1000, .width = 380, .height = 300};
  for (int frames = 0; frames < 30;) {
    FrameInfo frame;
    display->poll();
    display->begin(frame);
    if (frame.should_render) {
      ASSERT_TRUE(renderer->draw(scene, frame, *display)) << renderer->failure();
      ++frames;
    }
    display->end(frame);
  }
  // Frames are on their way for a while.
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const test::XServer server(std::getenv("MONADO_DISPLAY"));
  ASSERT_TRUE(server.answers());
  const test::XServer::Picture seen = server.picture(server.root());
  expect_golden("headset_window", {seen.width, seen.height, seen.rgb}, {.level = 16, .pixels = 800});
}

}  // namespace
}  // namespace onestroke
