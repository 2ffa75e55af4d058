// The render loop allocates nothing once warm. Counts every `new` of the loop's thread, so it is a program of its own.
#include "allocation/allocation_counter.h"
#include "app/frame_feed.h"
#include "app/show.h"
#include "app/source.h"
#include "display/offscreen.h"
#include "tracking/stereo_tracker.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

using test::allocations_of_this_thread;

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

/// Of one eye, or of two whose pictures are a pair.
class WarmShow : public testing::TestWithParam<int> {};

TEST_P(WarmShow, AllocatesNothing) {
  const int eyes = GetParam();
  const Catalog catalog = load_catalog(assets / "catalog.json");
  // A stick in front of the camera from the first picture on, with its model and its label.
  SourceOptions source;
  source.camera = "synthetic:script=turn_y,step_deg=2,width=640,height=480,fov_deg=35";
  if (eyes == 2) {
    source.second_camera = "synthetic";
    source.baseline_mm = 64;
  }
  const auto camera = open_source(source, catalog);
  {
    OffscreenDisplay display({.width = eyes * 320, .height = 240, .views = eyes});
    Graphics graphics(display,
                      {.catalog = catalog, .catalog_file = assets / "catalog.json", .models_first = true, .gpu = {}});
    make_room_for_words(display, graphics.renderer());
    StereoTracker tracker(catalog);
    TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::every);
    FrameFeed feed(tracking, Feed::Pace::each, PictureTime::exposure);
    SessionLog log(testing::TempDir() + "onestroke-show-allocation.jsonl", {});
    Show show({display, graphics, feed, &log});
    std::size_t shown = 0;
    long before = 0;
    show.run({.pictures = 40}, [&](std::size_t pictures) {
      shown = pictures;
      if (pictures <= 20) before = allocations_of_this_thread();
    });
    EXPECT_EQ(allocations_of_this_thread(), before);
    EXPECT_EQ(shown, 40u);
    log.close();
    EXPECT_EQ(log.failure(), "");
    std::filesystem::remove(log.file());
  }
}

INSTANTIATE_TEST_SUITE_P(Eyes, WarmShow, testing::Values(1, 2));

TEST(DesktopHud, AllocatesNothingAfterItsConstructor) {
  DesktopHud hud;
  HudWords words(true);
  FrameRecord record;
  for (MarkerObservation& m : record.markers) {
    m.name.fill('m');
    m.name.back() = 0;
    m.state = MarkerState::measured;
  }
  const long before = allocations_of_this_thread();
  for (int i = 0; i < 200; ++i) {
    // Markers come and go, figures grow, and the window changes its size.
    record.marker_count = i % (max_markers_per_frame + 1);
    words.update(
        record,
        {.tracker_ms = i * 10.0, .frames_a_second = i * 5.0, .latency = Latency{{}, {}, Duration::from_ms(i * 50)}});
    hud.lay_out(words, {0, 0, 300 + 9 * i, 200 + 7 * i});
  }
  EXPECT_EQ(allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace onestroke
