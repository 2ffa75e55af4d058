// The GPU is lost in the middle of a show, which goes on: every picture is shown, in its place, as if nothing had been.
#include "app/frame_feed.h"
#include "app/show.h"
#include "camera/open_camera.h"
#include "core/error.h"
#include "display/offscreen.h"
#include "golden/comparator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t pictures_in_all = 16;
// The line that tells the tracker's time stands below.
constexpr int figures_height = 40;

class Loss : public testing::Test {
 protected:
  ~Loss() override { fs::remove_all(folder); }
  void TearDown() override { EXPECT_EQ(validation_messages, 0); }

  /// A whole show into files; at_picture is called as the picture of each number, from 1, is about to be shown.
  void show(const std::string& name, const std::function<void(std::size_t)>& at_picture, double rate = 30) {
    const Catalog catalog = load_catalog(models / "catalog.json");
    const auto camera = open_camera({.spec = "synthetic:script=turn_y,step_deg=2,width=320,height=240,fov_deg=35",
                                     .fov_rad = {},
                                     .calibration = {},
                                     .readout = {},
                                     .catalog = &catalog});
    OffscreenDisplay display({.directory = folder / name, .width = 320, .height = 240, .rate = rate});
    Graphics graphics(
        display, {.catalog = catalog,
                  .catalog_file = models / "catalog.json",
                  .models_first = true,
                  .gpu = {.validation = true, .validation_messages = &validation_messages, .rehearsal = &rehearsal}});
    Tracker tracker(catalog);
    TrackingThread tracking(*camera, tracker, TrackingThread::Pacing::every);
    FrameFeed feed(tracking, Feed::Pace::each, PictureTime::exposure);
    Show show({display, graphics, feed});
    shown = 0;
    try {
      show.run({.pictures = pictures_in_all}, [&](std::size_t pictures) {
        shown = pictures;
        at_picture(pictures);
      });
    } catch (const Error& error) {
      said = error.what();
    }
    display.finish();
    report = display.report();
  }

  /// Loses the GPU with the n-th submission from now: 1 is the frame itself, 2 its way into the files.
  void lose(int submission) { rehearsal.submissions = submission; }

  golden::Picture picture(const std::string& name, int number) const {
    char file[32];
    std::snprintf(file, sizeof file, "frame_%06d.png", number);
    golden::Picture p = golden::read_png(folder / name / file);
    p.height -= figures_height;
    p.rgb.resize(3 * static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
    return p;
  }
  bool alike(const std::string& a, const std::string& b, int number) const {
    return golden::compare(picture(a, number), picture(b, number), {.level = 0}).same;
  }

  const fs::path folder = fs::path(testing::TempDir()) / ("loss_" + std::to_string(::getpid()));
  fs::path models = ONESTROKE_SOURCE_DIR "/assets";
  LossRehearsal rehearsal;
  std::atomic<int> validation_messages{0};
  std::size_t shown = 0;
  std::string said;
  std::vector<std::string> report;
};

TEST_F(Loss, OfOneGpuLosesNoPicture) {
  show("whole", [](std::size_t) {});
  for (const int submission : {1, 2}) {
    const std::string name = "lost_" + std::to_string(submission);
    show(name, [&](std::size_t picture) {
      if (picture == 7) lose(submission);
    });
    EXPECT_EQ(said, "");
    EXPECT_EQ(rehearsal.submissions, 0) << "it was lost";
    EXPECT_EQ(shown, pictures_in_all);
    EXPECT_THAT(report, ElementsAre(HasSubstr("frame_000015.png, 16 pictures"), HasSubstr("film.mp4, 16 frames")));
    for (int i = 0; i < static_cast<int>(pictures_in_all); ++i) EXPECT_TRUE(alike("whole", name, i)) << i;
  }
}

TEST_F(Loss, AtTheFirstAndAtTheLastPictureLosesNone) {
  show("whole", [](std::size_t) {});
  for (const std::size_t when : {std::size_t{1}, pictures_in_all}) {
    const std::string name = "lost_at_" + std::to_string(when);
    show(name, [&](std::size_t picture) {
      if (picture == when) lose(1);
    });
    EXPECT_EQ(said, "");
    EXPECT_THAT(report, ElementsAre(HasSubstr("16 pictures"), HasSubstr("film.mp4, 16 frames")));
    EXPECT_TRUE(alike("whole", name, 0));
    EXPECT_TRUE(alike("whole", name, 15));
  }
}

TEST_F(Loss, OfWorkThatWasUnderWayLeavesOutItsFrameAndKeepsTheOthersInPlace) {
  show("whole", [](std::size_t) {});
  rehearsal.work_too = true;
  show("lost", [&](std::size_t picture) {
    if (picture == 7) lose(1);
  });
  EXPECT_EQ(said, "");
  EXPECT_THAT(report, ElementsAre(HasSubstr("frame_000015.png, 15 pictures"), HasSubstr("film.mp4, 15 frames")));
  EXPECT_FALSE(fs::exists(folder / "lost" / "frame_000005.png")) << "it was on its way to the files";
  for (int i = 0; i < static_cast<int>(pictures_in_all); ++i) EXPECT_TRUE(i == 5 || alike("whole", "lost", i)) << i;
}

TEST_F(Loss, TwiceWithinAShortTimeEndsTheShow) {
  show("a", [&](std::size_t picture) {
    if (picture == 4 || picture == 9) lose(1);
  });
  EXPECT_EQ(said, "the GPU was lost twice within 10 seconds: update its driver, or choose another with --gpu");
  EXPECT_EQ(shown, 9u);
  // What was shown until then is whole.
  EXPECT_THAT(report, ElementsAre(HasSubstr("8 pictures"), HasSubstr("film.mp4, 8 frames")));
}

TEST_F(Loss, NowAndThenIsAnsweredEachTime) {
  // A frame a second: eleven of them lie between.
  show(
      "a",
      [&](std::size_t picture) {
        if (picture == 3 || picture == 14) lose(1);
      },
      1);
  EXPECT_EQ(said, "");
  EXPECT_THAT(report, ElementsAre(HasSubstr("16 pictures"), HasSubstr("film.mp4, 16 frames")));
}

TEST_F(Loss, SaysWhatKeepsItFromStartingAgain) {
  const fs::path assets = models;
  models = folder / "models";
  fs::create_directories(models);
  for (const char* file : {"catalog.json", "bracket_v1.glb", "bracket_v2.glb"})
    fs::copy_file(assets / file, models / file);
  show("a", [&](std::size_t picture) {
    if (picture != 4) return;
    fs::remove(models / "bracket_v2.glb");
    lose(1);
  });
  EXPECT_THAT(said, AllOf(HasSubstr("the GPU was lost and does not start again"), HasSubstr("bracket_v2.glb")));
}

}  // namespace
}  // namespace onestroke
