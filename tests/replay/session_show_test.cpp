// What keys did to a show is in its log, so that it is shown again as it was.
#include "app/frame_feed.h"
#include "app/replay_feed.h"
#include "app/show.h"
#include "camera/open_camera.h"
#include "display/offscreen.h"
#include "golden/solids.h"
#include "golden/stage.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

namespace onestroke {
namespace {

const std::filesystem::path assets = ONESTROKE_SOURCE_DIR "/assets";
constexpr int width = 320, height = 240;

/// An off-screen display at which keys are pressed before frames, and whose frames are kept.
class KeyedDisplay final : public Display {
 public:
  explicit KeyedDisplay(std::map<std::size_t, Key> presses = {})
      : presses_(std::move(presses)), inner_({.width = width, .height = height}) {}

  GpuNeeds needs() const override { return inner_.needs(); }
  void attach(Gpu& gpu) override { inner_.attach(gpu); }
  void begin(FrameInfo& frame) override { inner_.begin(frame); }
  void end(const FrameInfo& frame) override {
    inner_.end(frame);
    if (frame.should_render) pictures.push_back(golden::from_rgba(width, height, inner_.read_back()));
  }
  std::span<const Key> poll() override {
    const auto found = presses_.find(pictures.size());
    if (found == presses_.end()) return {};
    return {&found->second, 1};
  }
  bool closed() const override { return inner_.closed(); }
  bool tracks_head() const override { return false; }
  void finish() override { inner_.finish(); }

  std::vector<golden::Picture> pictures;

 private:
  const std::map<std::size_t, Key> presses_;
  OffscreenDisplay inner_;
};

class SessionShow : public testing::Test {
 protected:
  std::unique_ptr<Camera> open() const {
    return open_camera({.spec = "synthetic:noise=2,width=320,height=240,fov_deg=35,fps=4",
                        .fov_rad = {},
                        .calibration = {},
                        .readout = {},
                        .catalog = &catalog});
  }
  Graphics graphics_for(Display& display) const {
    return Graphics(display,
                    {.catalog = catalog, .catalog_file = assets / "catalog.json", .models_first = true, .gpu = {}});
  }

  std::vector<golden::Picture> show_live(const std::map<std::size_t, Key>& presses, std::size_t pictures = 12) const {
    const auto camera = open();
    KeyedDisplay display(presses);
    Graphics graphics = graphics_for(display);
    Tracker tracker(catalog);
    TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::every);
    FrameFeed feed(tracking, Feed::Pace::each, PictureTime::exposure);
    SessionLog log(file, {});
    Show({display, graphics, feed, &log}).run({.pictures = pictures}, [](std::size_t) {});
    return std::move(display.pictures);
  }

  std::vector<golden::Picture> show_again() const {
    const auto camera = open();
    KeyedDisplay display;
    Graphics graphics = graphics_for(display);
    SessionReader session(file);
    ReplayFeed feed(session);
    feed.use(camera.get());
    Show({display, graphics, feed}).run({}, [](std::size_t) {});
    return std::move(display.pictures);
  }

  void TearDown() override { std::filesystem::remove(file); }

  const Catalog catalog = load_catalog(assets / "catalog.json");
  const std::filesystem::path file = testing::TempDir() + "onestroke-session-show.jsonl";
};

// Two keys are enough to leave by, as they are the buttons of a headset's controllers.
TEST_F(SessionShow, EndsWhereLeavingIsPickedFromTheMenu) {
  std::map<std::size_t, Key> presses{{1, Key::enter}};
  // The last of what is offered, then to be sure the first of two.
  for (std::size_t frame = 2; frame < 13; ++frame) presses[frame] = Key::tab;
  presses[13] = Key::enter;
  presses[14] = Key::tab;
  presses[15] = Key::enter;
  const auto live = show_live(presses, 40);
  EXPECT_EQ(live.size(), 16u);
  std::ifstream in(file);
  const std::string log(std::istreambuf_iterator<char>(in), {});
  EXPECT_NE(log.find("\"events\":[\"Leave\"]"), std::string::npos);
  EXPECT_EQ(show_again().size(), live.size());
}

TEST_F(SessionShow, ItsKeysAreInTheLog) {
  const auto live =
      show_live({{2, Key{'l'}}, {4, Key::space}, {6, Key::space}, {8, Key{'h'}}, {10, Key{'h'}}, {11, Key{'l'}}});
  std::ifstream in(file);
  const std::string log(std::istreambuf_iterator<char>(in), {});
  EXPECT_NE(log.find("\"bracket v1\""), std::string::npos) << "a stick is there";
  EXPECT_NE(log.find("\"events\":[\"Link\"]"), std::string::npos);
  EXPECT_NE(log.find("\"events\":[\"Mirror\"]"), std::string::npos);
  const auto again = show_again();
  ASSERT_EQ(live.size(), 14u) << "12 pictures, and 2 frames of a pause";
  ASSERT_EQ(again.size(), live.size());
  for (std::size_t i = 0; i < live.size(); ++i)
    EXPECT_TRUE(golden::compare(live[i], again[i], {.level = 0}).same) << "frame " << i;
  EXPECT_TRUE(golden::compare(live[3], live[4], {.level = 0}).same) << "the pause";
  EXPECT_FALSE(golden::compare(live[7], live[8], {.level = 0}).same) << "words hide";
}

}  // namespace
}  // namespace onestroke
