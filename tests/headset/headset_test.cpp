// The headset's display on a runtime that nobody here wrote: Monado with its
// simulated headset. CMake runs this with with_monado.
#include "headset/headset.h"

#include "core/error.h"
#include "desktop/x_server.h"
#include "display/openxr_wait.h"

#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <thread>

namespace onestroke {
namespace {

using testing::HasSubstr;

using AnyHead = Headset;
using OtherProgram = Headset;
using StillHead = Headset;
using WobblingHead = Headset;
using Window = Headset;

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
      if (!blink()) ++waited;
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
    blink();
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
  std::vector<double> apart_mm, apart_rad;
  for (const auto& [frame, head] : show_and_ask(60)) {
    const Pose &left = frame.views[0].T_world_view, &right = frame.views[1].T_world_view;
    apart_mm.push_back(norm(head.translation - 0.5 * (left.translation + right.translation)));
    apart_rad.push_back(angle_between(head.rotation, left.rotation));
  }
  ASSERT_GT(apart_mm.size(), 40U);
  // A clock that is 5 ms off makes 0.5 mm and 0.00025 rad of it; a frame
  // between samples far apart is no matter.
  EXPECT_LT(median_of(apart_mm), 0.25);
  EXPECT_LT(median_of(apart_rad), 0.0001);
}

TEST_F(WobblingHead, ViewsMoveSmoothly) {
  show(60);
  const auto [fastest, farthest] = fastest_and_farthest(shown);
  EXPECT_GT(farthest, 20) << "mm";
  EXPECT_LT(fastest, 1000) << "mm/s";
}

TEST_F(Window, BothEyesSeeWhatWasDrawn) {
  show(30, {0.5F, 0.2F, 0.05F, 1});
  // sRGB of the linear colour.
  const std::array expected{188, 124, 63};
  const test::XServer screen(std::getenv("MONADO_DISPLAY"));
  ASSERT_TRUE(screen.answers());
  for (const int x : {100, 740}) {
    const auto seen = screen.pixel(screen.root(), x, 80);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(seen.at(i), expected.at(i), 2) << "at " << x << ", channel " << i;
  }
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
    wait_for_headset({}, give_up);
    ADD_FAILURE() << "there is one";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("the OpenXR runtime does not answer: start its service"));
  }
  EXPECT_TRUE(give_up());
}

}  // namespace
}  // namespace onestroke
