// The desktop's figures as they look.
#include "app/desktop_hud.h"
#include "golden/solids.h"
#include "golden/stage.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

FrameRecord record_of_three() {
  FrameRecord record;
  record.marker_count = 3;
  const auto set = [&record](std::size_t i, const std::string& name, MarkerState state, int cells, Vec3 at) {
    MarkerObservation& m = record.markers[i];
    std::copy(name.begin(), name.end(), m.name.begin());
    m.state = state;
    m.cells_seen = cells;
    m.T_camera_marker.translation = at;
  };
  set(0, "bracket v1", MarkerState::measured, 31, {30, 40, 412});
  set(1, "a name that is too long for its column", MarkerState::predicted, 0, {0, 0, 1388});
  set(2, "Größe 3", MarkerState::lost, 0, {});
  return record;
}

class HudPicture : public golden::Stage {
 protected:
  HudPicture() : chart(width, height, PixelFormat::rgb8, fov) {
    renderer->set_picture(chart.picture);
    words.update(record_of_three(), {.tracker_ms = 8.25,
                                     .pictures_a_second = 29.8,
                                     .frames_a_second = 60.1,
                                     .age = Duration::from_ms(23.4),
                                     .left_out = 3});
  }

  const golden::Chart chart;
  DesktopHud hud;
  HudWords words{true};
};

TEST_F(HudPicture, StandsOverPictureAndModels) {
  const std::array instances{
      ModelInstance{.model = renderer->load(golden::torus(0.05F, 0.02F, {.metallic = 0, .roughness = 0.5F})),
                    .world_graphics_from_model = golden::placed(-0.05F, -0.05F, -0.4F, -0.6F, 0.3F)}};
  const std::array text{HudText{.text = "words beside it", .x = 10, .y = 10, .height_px = 14}};
  const ImDrawData& gui = hud.lay_out(words, {0, 0, width, height});
  expect_golden("hud", draw({.instances = instances, .hud = text, .gui = &gui}), {.level = 3, .pixels = 60});
}

class HudPictureStereo : public golden::StereoStage {};

TEST_F(HudPictureStereo, IsNotShownToTwoEyes) {
  DesktopHud hud;
  HudWords words(true);
  words.update(record_of_three(), {});
  const golden::Picture without = draw({});
  const ImDrawData& gui = hud.lay_out(words, {0, 0, width, height});
  EXPECT_TRUE(golden::compare(without, draw({.gui = &gui}), {.level = 0}).same);
}

}  // namespace
}  // namespace onestroke
