// The desktop's figures as they look, and where a show has them.
#include "app/desktop_hud.h"
#include "app/frame_feed.h"
#include "app/show.h"
#include "camera/open_camera.h"
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
    words.update(record_of_three(),
                 {.tracker_ms = 8.25,
                  .pictures_a_second = 29.8,
                  .frames_a_second = 60.1,
                  .latency = Latency{Duration::from_ms(11.4), Duration::from_ms(15.2), Duration::from_ms(23.4)},
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

/// An off-screen display at which keys are pressed, and whose frames are kept.
class WatchedDisplay final : public Display {
 public:
  struct Wanted {
    int views = 1;
    bool tracks_head = false;
    std::vector<int> presses_h{};  ///< Before the frames of these numbers, from 0.
  };

  explicit WatchedDisplay(const Wanted& wanted)
      : wanted_(wanted), inner_({.width = 640, .height = 480, .views = wanted.views}) {}

  GpuNeeds needs() const override { return inner_.needs(); }
  void attach(Gpu& gpu) override { inner_.attach(gpu); }
  void begin(FrameInfo& frame) override { inner_.begin(frame); }
  void end(const FrameInfo& frame) override {
    inner_.end(frame);
    if (frame.should_render) pictures.push_back(golden::from_rgba(640, 480, inner_.read_back()));
  }
  std::span<const Key> poll() override {
    const auto now = static_cast<int>(pictures.size());
    const bool pressed = std::ranges::find(wanted_.presses_h, now) != wanted_.presses_h.end();
    return {&h_, pressed ? 1U : 0U};
  }
  bool closed() const override { return inner_.closed(); }
  bool tracks_head() const override { return wanted_.tracks_head; }
  void finish() override { inner_.finish(); }

  std::vector<golden::Picture> pictures;

 private:
  const Wanted wanted_;
  const Key h_{'h'};
  OffscreenDisplay inner_;
};

/// Shows a picture that stands still six times.
std::vector<golden::Picture> watch(const WatchedDisplay::Wanted& wanted) {
  const std::filesystem::path assets = ONESTROKE_SOURCE_DIR "/assets";
  const Catalog catalog = load_catalog(assets / "catalog.json");
  const auto camera = open_camera({.spec = "synthetic:script=still,noise=0,width=640,height=480",
                                   .fov_rad = {},
                                   .calibration = {},
                                   .readout = {},
                                   .catalog = &catalog});
  WatchedDisplay display(wanted);
  Graphics graphics(display,
                    {.catalog = catalog, .catalog_file = assets / "catalog.json", .models_first = true, .gpu = {}});
  Tracker tracker(catalog);
  TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::every);
  FrameFeed feed(tracking, Feed::Pace::each, PictureTime::exposure);
  Show show({display, graphics, feed});
  show.run({.pictures = 6}, [](std::size_t) {});
  return std::move(display.pictures);
}

/// Right of the lowest line's words, where the panel has nothing but itself.
std::array<int, 3> panel_of(const golden::Picture& picture) {
  const std::uint8_t* p = picture.at(295, 461);
  return {p[0], p[1], p[2]};
}

TEST(ShowFigures, HideWithTheWords) {
  const auto pictures = watch({.presses_h = {2, 4}});
  ASSERT_EQ(pictures.size(), 6u);
  EXPECT_NE(panel_of(pictures[1]), panel_of(pictures[2]));
  EXPECT_EQ(panel_of(pictures[2]), panel_of(pictures[3]));
  EXPECT_EQ(panel_of(pictures[4]), panel_of(pictures[1]));
}

TEST(ShowFigures, AreForOneViewOnADeskAlone) {
  for (const WatchedDisplay::Wanted& wanted :
       {WatchedDisplay::Wanted{.views = 2, .presses_h = {2}}, {.tracks_head = true, .presses_h = {2}}}) {
    const auto pictures = watch(wanted);
    ASSERT_EQ(pictures.size(), 6u);
    EXPECT_EQ(panel_of(pictures[1]), panel_of(pictures[2]));
    EXPECT_FALSE(golden::compare(pictures[1], pictures[2], {}).same) << "the line of words is there, and hides";
  }
}

}  // namespace
}  // namespace onestroke
