// The headset's display on a runtime that nobody here wrote: Monado with its
// simulated headset. CMake runs this with with_monado.
#include "core/error.h"
#include "display/openxr.h"
#include "display/openxr_wait.h"
#include "golden/comparator.h"
#include "golden/solids.h"
#include "golden/stage.h"
#include "render/target.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <thread>

namespace onestroke {
namespace {

using testing::HasSubstr;

constexpr Duration longest_show = Duration::from_seconds(150);

/// What this thread has used so far.
Duration cpu_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return {std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec};
}

template <typename T>
T median_of(std::vector<T> values) {
  std::ranges::sort(values);
  return values.at(values.size() / 2);
}

class Headset : public testing::Test {
 protected:
  void SetUp() override {
    display.emplace();
    start();
  }
  /// Brings the headset a GPU.
  void start() {
    renderer.reset();
    Gpu gpu({.needs = display->needs(), .validation = true, .validation_messages = &validation_messages});
    display->attach(gpu);
    renderer.emplace(gpu);
    ring = renderer->load(golden::torus(0.05F, 0.02F, {}));
  }
  void TearDown() override {
    if (display) display->finish();
    renderer.reset();
    display.reset();
    EXPECT_EQ(validation_messages, 0);
  }

  /// Shows so many frames of a ring before a colour, and keeps what the display
  /// said of each.
  void show(std::size_t frames, const Color& color = {}) {
    const std::array instances{
        ModelInstance{.model = ring, .world_graphics_from_model = golden::placed(0, 0, -0.4F, 0, 0)}};
    const Time until = Time::now() + longest_show;
    shown.clear();
    ahead.clear();
    cpu.clear();
    while (shown.size() < frames && Time::now() < until && !display->closed()) {
      display->poll();
      const Duration cpu_begun = cpu_time();
      FrameInfo frame;
      display->begin(frame);
      const Time begun = Time::now();
      if (frame.should_render) {
        ASSERT_TRUE(renderer->draw({.background = color, .instances = instances}, frame)) << renderer->failure();
        shown.push_back(frame);
        ahead.push_back(frame.time - begun);
      }
      display->end(frame);
      if (frame.should_render) cpu.push_back(cpu_time() - cpu_begun);
    }
    ASSERT_EQ(shown.size(), frames) << "closed: " << display->closed();
  }

  std::atomic<int> validation_messages{0};
  std::optional<OpenXrDisplay> display;
  std::optional<Renderer> renderer;
  ModelHandle ring;
  std::vector<FrameInfo> shown;
  std::vector<Duration> ahead, cpu;
};

using AnyHead = Headset;
using OtherProgram = Headset;
using StillHead = Headset;
using WobblingHead = Headset;
using Window = Headset;
using StillWindow = Headset;

TEST_F(AnyHead, SeesAPairOfViewsInTwoLayers) {
  show(20);
  EXPECT_TRUE(display->tracks_head());
  for (const FrameInfo& frame : shown) {
    ASSERT_EQ(frame.view_count, 2);
    EXPECT_EQ(frame.target->layers, 2);
    const Vec3 between = frame.views[1].T_world_view.translation - frame.views[0].T_world_view.translation;
    EXPECT_NEAR(norm(between), 63, 10);
    EXPECT_GT(rotate(frame.views[0].T_world_view.rotation.conjugate(), between).x, 50) << "the right eye is right";
    for (const View& view : frame.views) {
      EXPECT_LT(view.fov.left, 0);
      EXPECT_GT(view.fov.right, 0);
      EXPECT_GT(view.fov.up, 0);
      EXPECT_LT(view.fov.down, 0);
      EXPECT_EQ(view.viewport.width, frame.target->width);
      EXPECT_EQ(view.viewport.height, frame.target->height);
    }
  }
}

TEST_F(AnyHead, ShowsSixHundredFrames) {
  show(600);
  display->finish();
  for (const std::string& line : display->report()) std::cout << line << '\n';
  std::cout << "600 frames in " << (shown.back().time - shown.front().time).seconds()
            << " s; CPU time of this thread per frame: " << median_of(cpu).ms() << " ms\n";
}

TEST_F(AnyHead, FramesAreTimedOnOurClock) {
  show(40);
  for (std::size_t i = 1; i < shown.size(); ++i) EXPECT_GT(shown[i].time, shown[i - 1].time);
  const Duration median = median_of(ahead);
  EXPECT_GT(median.ms(), 0);
  EXPECT_LT(median.ms(), 100);
}

TEST_F(AnyHead, IsShownAgainWithAnotherGpu) {
  show(5);
  start();
  show(5);
}

TEST_F(AnyHead, IsShownAgainByAnotherDisplay) {
  show(5);
  display->finish();
  EXPECT_TRUE(display->closed());
  EXPECT_THAT(display->report(), testing::ElementsAre(HasSubstr("showed 5 of ")));
  renderer.reset();
  display.emplace();
  start();
  show(5);
}

/// A frame of nothing; whether it was wanted.
bool blink(OpenXrDisplay& display, Renderer& renderer) {
  FrameInfo frame;
  display.poll();
  display.begin(frame);
  if (frame.should_render) {
    EXPECT_TRUE(renderer.draw({}, frame)) << renderer.failure();
  }
  display.end(frame);
  return frame.should_render;
}

/// What the other program does.
TEST_F(OtherProgram, ShowsForASecond) {
  show(10);
  const Time until = shown.back().time + Duration::from_seconds(1);
  while (shown.back().time < until) show(1);
}

TEST_F(AnyHead, GivesWayToAnotherProgramAndComesBack) {
  show(10);
  std::atomic<bool> over{false};
  int status = -1, waited = 0;
  const std::string other =
      std::string(std::getenv("MONADO_RUN")) + " " HEADSET_PROGRAM " --gtest_filter=OtherProgram.*";
  {
    const std::jthread program([&] {
      status = std::system(other.c_str());
      over = true;
    });
    while (!over && !display->closed())
      if (!blink(*display, *renderer)) ++waited;
  }
  EXPECT_EQ(status, 0);
  EXPECT_GT(waited, 10);
  show(10);
}

TEST_F(AnyHead, ComesBackWhenTheServiceWasKilled) {
  show(10);
  int service = 0;
  std::ifstream(std::getenv("MONADO_PID_FILE")) >> service;
  ASSERT_GT(service, 0);
  ASSERT_EQ(kill(service, SIGKILL), 0);
  for (const Time until = Time::now() + longest_show; !display->gpu_lost() && Time::now() < until;) {
    ASSERT_FALSE(display->closed());
    blink(*display, *renderer);
  }
  ASSERT_TRUE(display->gpu_lost());
  start();
  EXPECT_FALSE(display->gpu_lost());
  show(10);
}

TEST_F(StillHead, ViewsStayWhereTheyAre) {
  show(30);
  const View& first = shown.front().views[0];
  for (const FrameInfo& frame : shown) {
    EXPECT_NEAR(norm(frame.views[0].T_world_view.translation - first.T_world_view.translation), 0, 1e-3);
    EXPECT_NEAR(angle_between(frame.views[0].T_world_view.rotation, first.T_world_view.rotation), 0, 1e-6);
  }
}

// The runtime predicted the eyes for when they would see the frame; the head's
// history tells where they were then. The simulated head moves by a formula, so
// that its predictions come true.
TEST_F(WobblingHead, TheHeadIsRememberedWhereItWasPredicted) {
  show(60);
  std::vector<double> apart_mm, apart_rad;
  for (const FrameInfo& frame : shown) {
    const auto head = frame.time < Time::now() ? display->head_at(frame.time) : std::nullopt;
    if (!head) continue;
    const Pose &left = frame.views[0].T_world_view, &right = frame.views[1].T_world_view;
    apart_mm.push_back(norm(head->translation - 0.5 * (left.translation + right.translation)));
    apart_rad.push_back(angle_between(head->rotation, left.rotation));
  }
  ASSERT_GT(apart_mm.size(), 40U);
  // A clock that is 5 ms off makes 0.5 mm and 0.00025 rad of it; a frame
  // between samples far apart is no matter.
  EXPECT_LT(median_of(apart_mm), 0.25);
  EXPECT_LT(median_of(apart_rad), 0.0001);
}

TEST_F(WobblingHead, ViewsMoveSmoothly) {
  show(60);
  double longest_step = 0, farthest = 0;
  for (std::size_t i = 1; i < shown.size(); ++i) {
    const Vec3 here = shown[i].views[0].T_world_view.translation;
    const double step = norm(here - shown[i - 1].views[0].T_world_view.translation);
    longest_step = std::max(longest_step, step / (shown[i].time - shown[i - 1].time).seconds());
    farthest = std::max(farthest, norm(here - shown[0].views[0].T_world_view.translation));
  }
  EXPECT_GT(farthest, 20) << "mm";
  EXPECT_LT(longest_step, 1000) << "mm/s";
}

/// The screen that Monado's window fills.
golden::Picture screen() {
  ::Display* server = XOpenDisplay(std::getenv("MONADO_DISPLAY"));
  EXPECT_TRUE(server);
  if (!server) return {};
  const int width = DisplayWidth(server, 0), height = DisplayHeight(server, 0);
  XImage* image = XGetImage(server, DefaultRootWindow(server), 0, 0, static_cast<unsigned>(width),
                            static_cast<unsigned>(height), AllPlanes, ZPixmap);
  EXPECT_TRUE(image);
  golden::Picture picture{width, height, {}};
  for (int y = 0; image && y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const unsigned long p = XGetPixel(image, x, y);
      for (const unsigned shift : {16U, 8U, 0U}) picture.rgb.push_back(static_cast<std::uint8_t>(p >> shift & 255U));
    }
  if (image) XDestroyImage(image);
  XCloseDisplay(server);
  return picture;
}

TEST_F(Window, BothEyesSeeWhatWasDrawn) {
  show(30, {0.5F, 0.2F, 0.05F, 1});
  // sRGB of the linear colour.
  const std::array expected{188, 124, 63};
  const golden::Picture seen = screen();
  for (const int x : {100, 740})
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(seen.at(x, 80)[i], expected.at(i), 2) << "at " << x << ", channel " << i;
}

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
  expect_golden("headset_window", screen(), {.level = 16, .pixels = 800});
}

std::string refusal() {
  try {
    OpenXrDisplay display;
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(NoRuntime, IsSaidWithTheRemedy) {
  EXPECT_THAT(refusal(), HasSubstr("there is no OpenXR runtime: install Monado"));
}

TEST(NoHeadset, IsSaidWithTheRemedy) {
  EXPECT_THAT(refusal(), HasSubstr("the OpenXR runtime a fake finds no headset: plug it in, switch it on"));
}

TEST(NoVulkan, IsSaidWithTheRemedy) {
  EXPECT_THAT(refusal(), HasSubstr("the OpenXR runtime lacks XR_KHR_vulkan_enable2: update it"));
}

TEST(NoClock, IsSaidWithTheRemedy) {
  EXPECT_THAT(refusal(), HasSubstr("the OpenXR runtime lacks XR_KHR_convert_timespec_time: update it"));
}

TEST(NoService, IsSaidWithTheRemedy) {
  EXPECT_THAT(refusal(), HasSubstr("the OpenXR runtime does not answer: start its service"));
}

TEST(NoService, IsWaitedForUntilSomebodyGivesUp) {
  static const Time began = Time::now();
  const auto give_up = [] { return Time::now() - began > Duration::from_seconds(2.5); };
  try {
    wait_for_headset(give_up);
    ADD_FAILURE() << "there is one";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the OpenXR runtime does not answer: start its service"));
  }
  EXPECT_TRUE(give_up());
}

}  // namespace
}  // namespace onestroke
