#include "display/offscreen.h"

#include "core/error.h"
#include "display/film.h"
#include "display/open_display.h"
#include "display/png_file.h"
#include "golden/comparator.h"
#include "golden/stage.h"
#include "render/target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include <algorithm>
#include <fstream>

extern "C" {
#include <libavformat/avformat.h>
}

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Offscreen : public testing::Test {
 protected:
  const fs::path directory = fs::path(testing::TempDir()) / ("offscreen_" + std::to_string(::getpid()));
  std::atomic<int> validation_messages{0};

  ~Offscreen() override { fs::remove_all(directory); }
  void TearDown() override { EXPECT_EQ(validation_messages, 0); }

  /// Draws backgrounds that grow lighter frame by frame. The GPU is lost with one of the submissions, of which a frame
  /// makes two: itself and its way into the files.
  void show(Display& display, int frames, int lost_with = 0) {
    Gpu gpu({.needs = display.needs(),
             .validation = true,
             .validation_messages = &validation_messages,
             .rehearsal = &rehearsal});
    display.attach(gpu);
    Renderer renderer(gpu);
    rehearsal.submissions = lost_with;
    for (int i = 0; i < frames && !display.closed() && !display.gpu_lost(); ++i) {
      FrameInfo frame;
      display.begin(frame);
      times.push_back(frame.time.ns);
      const float level = 0.1F * static_cast<float>(i + 1);
      ASSERT_TRUE(renderer.draw({.background = {level, level, level, 1}}, frame));
      display.end(frame);
    }
  }

  std::vector<std::int64_t> times;
  LossRehearsal rehearsal;
};

/// When a player shows a film's frames, ms.
std::vector<double> shown_at(const fs::path& film) {
  std::vector<double> times;
  AVFormatContext* format = nullptr;
  if (avformat_open_input(&format, film.c_str(), nullptr, nullptr) < 0) return times;
  AVPacket* packet = av_packet_alloc();
  while (av_read_frame(format, packet) >= 0) {
    times.push_back(1000 * static_cast<double>(packet->pts) * av_q2d(format->streams[0]->time_base));
    av_packet_unref(packet);
  }
  av_packet_free(&packet);
  avformat_close_input(&format);
  // They are packed in the order in which they are decoded.
  std::sort(times.begin(), times.end());
  return times;
}

/// Linear light as an 8-bit sRGB value.
int srgb(double linear) {
  return static_cast<int>(std::lround(255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055)));
}

TEST_F(Offscreen, LeavesNumberedPicturesAndAFilm) {
  const auto display =
      open_display("offscreen:" + directory.string(), {.width = 64, .height = 48, .rate = 25, .png_every = 2});
  show(*display, 5);
  display->finish();
  display->finish();  // harmless
  EXPECT_THAT(times, testing::ElementsAre(0, 40'000'000, 80'000'000, 120'000'000, 160'000'000));
  EXPECT_FALSE(fs::exists(directory / "frame_000001.png"));
  for (const int i : {0, 2, 4}) {
    const auto p = golden::read_png(directory / ("frame_00000" + std::to_string(i) + ".png"));
    EXPECT_EQ(p.width, 64);
    EXPECT_EQ(p.height, 48);
    EXPECT_NEAR(p.at(30, 20)[0], srgb(0.1 * (i + 1)), 1);
  }
  EXPECT_THAT(display->report(),
              testing::ElementsAre(HasSubstr("frame_000004.png, 3 pictures"), HasSubstr("film.mp4, 5 frames")));

  cv::VideoCapture film((directory / "film.mp4").string());
  ASSERT_TRUE(film.isOpened());
  EXPECT_EQ(film.get(cv::CAP_PROP_FRAME_WIDTH), 64);
  EXPECT_NEAR(film.get(cv::CAP_PROP_FPS), 25, 1e-6);
  cv::Mat picture;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(film.read(picture));
    EXPECT_NEAR(picture.at<cv::Vec3b>(20, 30)[1], srgb(0.1 * (i + 1)), 3);
  }
  EXPECT_FALSE(film.read(picture));
}

TEST_F(Offscreen, GoesOnWithAnotherGpuWhereOneWasLost) {
  OffscreenDisplay display({.directory = directory, .width = 64, .height = 48, .rate = 25});
  show(display, 20, 6);  // the third frame's way into the files
  EXPECT_TRUE(display.gpu_lost());
  EXPECT_FALSE(display.closed());
  FrameInfo frame;
  display.begin(frame);
  EXPECT_FALSE(frame.should_render);
  display.end(frame);
  show(display, 2);
  EXPECT_FALSE(display.gpu_lost());
  display.finish();
  EXPECT_THAT(times, testing::ElementsAre(0, 40'000'000, 80'000'000, 80'000'000, 120'000'000));
  EXPECT_THAT(display.report(),
              testing::ElementsAre(HasSubstr("frame_000003.png, 4 pictures"), HasSubstr("film.mp4, 4 frames")));
  EXPECT_NEAR(golden::read_png(directory / "frame_000001.png").at(30, 20)[0], srgb(0.2), 1);
  EXPECT_NEAR(golden::read_png(directory / "frame_000002.png").at(30, 20)[0], srgb(0.1), 1);
}

TEST_F(Offscreen, KeepsTheOthersTimeWhereAFrameIsLost) {
  OffscreenDisplay display({.directory = directory, .width = 64, .height = 48, .rate = 25});
  rehearsal.work_too = true;
  show(display, 20, 6);
  show(display, 3);
  display.finish();
  // The second was on its way; the third was not yet taken.
  EXPECT_FALSE(fs::exists(directory / "frame_000001.png"));
  EXPECT_THAT(display.report(),
              testing::ElementsAre(HasSubstr("frame_000004.png, 4 pictures"), HasSubstr("film.mp4, 4 frames")));
  const std::vector<double> times_ms = shown_at(directory / "film.mp4");
  EXPECT_THAT(times_ms, testing::ElementsAre(0, 80, 120, 160));
}

TEST_F(Offscreen, SaysWhereTheLastFramesWentWithTheGpu) {
  OffscreenDisplay display({.directory = directory, .width = 64, .height = 48, .rate = 25});
  rehearsal.work_too = true;
  show(display, 20, 6);
  try {
    display.finish();
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the GPU was lost with the last frames"));
  }
  EXPECT_THAT(display.report(), testing::ElementsAre(HasSubstr("1 pictures"), HasSubstr("film.mp4, 1 frames")));
  EXPECT_TRUE(cv::VideoCapture((directory / "film.mp4").string()).isOpened()) << "the film is whole all the same";
}

TEST_F(Offscreen, FilmsColoursAndOddSizes) {
  constexpr int width = 63, height = 41;
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < width * height; ++i) rgba.insert(rgba.end(), {200, 60, 120, 255});
  fs::create_directories(directory);
  Film film(directory / "odd.mp4", width, height, 30);
  for (int i = 0; i < 3; ++i) film.add(rgba);
  film.finish();
  cv::VideoCapture shown((directory / "odd.mp4").string());
  cv::Mat picture;
  ASSERT_TRUE(shown.read(picture));
  EXPECT_EQ(picture.cols, 62);
  EXPECT_EQ(picture.rows, 40);
}

TEST_F(Offscreen, SaysWhereItCannotWrite) {
  fs::create_directories(directory);
  std::ofstream(directory / "file") << "in the way";
  for (const auto& where : {directory / "file" / "below", directory / "file"}) {
    try {
      OffscreenDisplay display({.directory = where});
      FAIL();
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("cannot write to " + where.string()));
    }
  }
}

TEST_F(Offscreen, ClosesWhenTheDiskIsFullAndSaysSo) {
  fs::create_directories(directory);
  fs::create_symlink("/dev/full", directory / "frame_000002.png");
  OffscreenDisplay display({.directory = directory, .width = 64, .height = 48, .film = false});
  show(display, 20);
  EXPECT_TRUE(display.closed());
  EXPECT_LT(times.size(), 8U);
  try {
    display.finish();
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame_000002.png: No space left on device"));
  }
}

TEST_F(Offscreen, SaysWhenTheFilmDoesNotFit) {
  std::vector<std::uint8_t> rgba(64 * 64 * 4, 100);
  EXPECT_THROW(
      {
        Film film("/dev/full", 64, 64, 30);
        for (int i = 0; i < 200; ++i) film.add(rgba);
        film.finish();
      },
      Error);
}

TEST_F(Offscreen, PlacesTwoEyesSideBySide) {
  OffscreenDisplay display({.width = 200, .height = 80, .views = 2, .eye_distance_mm = 60});
  Gpu gpu({.needs = display.needs()});
  display.attach(gpu);
  FrameInfo frame;
  display.begin(frame);
  ASSERT_EQ(frame.view_count, 2);
  EXPECT_EQ(frame.views[0].T_world_view.translation, (Vec3{-30, 0, 0}));
  EXPECT_EQ(frame.views[1].T_world_view.translation, (Vec3{30, 0, 0}));
  // Each eye has a layer of its own.
  EXPECT_EQ(frame.target->layers, 2);
  EXPECT_EQ(frame.target->width, 100);
  EXPECT_EQ(frame.views[1].viewport.x, 0);
  EXPECT_EQ(frame.views[1].viewport.width, 100);
  EXPECT_DOUBLE_EQ(frame.views[0].fov.right / frame.views[0].fov.up, 100.0 / 80);
}

TEST_F(Offscreen, RefusesWhatItCannotDo) {
  EXPECT_THROW(OffscreenDisplay({.width = 0}), UsageError);
  EXPECT_THROW(OffscreenDisplay({.rate = 0}), UsageError);
  EXPECT_THROW(OffscreenDisplay({.views = 3}), UsageError);
  EXPECT_THROW(OffscreenDisplay({.width = 201, .views = 2}), UsageError);
  EXPECT_THROW(open_display("offscreen:", {}), UsageError);
  EXPECT_THROW(open_display("cinema", {}), UsageError);
}

}  // namespace
}  // namespace onestroke
