#pragma once

#include "display/openxr.h"
#include "golden/solids.h"
#include "golden/stage.h"
#include "render/target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

namespace onestroke {

constexpr Duration longest_show = Duration::from_seconds(150);

/// What this thread has used so far.
inline Duration cpu_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return {std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec};
}

/// The value that so much of all is not above.
template <typename T>
T quantile_of(std::vector<T> values, double part) {
  std::ranges::sort(values);
  return values.at(static_cast<std::size_t>(part * static_cast<double>(values.size() - 1) + 0.5));
}
template <typename T>
T median_of(std::vector<T> values) {
  return quantile_of(std::move(values), 0.5);
}

/// How the left eye went from frame to frame: mm/s at most, and how far from the first, mm.
inline std::pair<double, double> fastest_and_farthest(const std::vector<FrameInfo>& shown) {
  double fastest = 0, farthest = 0;
  for (std::size_t i = 1; i < shown.size(); ++i) {
    const Vec3 here = shown[i].views[0].T_world_view.translation;
    const double step = norm(here - shown[i - 1].views[0].T_world_view.translation);
    fastest = std::max(fastest, step / (shown[i].time - shown[i - 1].time).seconds());
    farthest = std::max(farthest, norm(here - shown[0].views[0].T_world_view.translation));
  }
  return {fastest, farthest};
}

/// A headset of the active runtime, and what is shown in it under validation.
class Headset : public testing::Test {
 protected:
  void SetUp() override {
    display.emplace(options);
    start();
  }
  /// Brings the headset a GPU.
  void start() {
    renderer.reset();
    Gpu gpu({.needs = display->needs(), .validation = validation, .validation_messages = &validation_messages});
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
      const Duration cpu_begun = cpu_time();
      for (const Key key : display->poll()) keys.push_back(key);
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

  /// Where the head was, as the display remembers it, when a frame was seen.
  struct Remembered {
    FrameInfo frame;
    Pose T_world_head;
  };
  /// Shows so many frames, asks for each as soon as it was seen, and leaves all in `shown`. A busy machine may take
  /// longer over them than the display remembers.
  std::vector<Remembered> show_and_ask(std::size_t frames) {
    std::vector<Remembered> remembered;
    std::vector<FrameInfo> all, not_seen_yet;
    const auto ask = [&](const FrameInfo& frame) {
      if (frame.time >= Time::now()) return false;
      if (const auto head = display->head_at(frame.time)) remembered.push_back({frame, *head});
      return true;
    };
    while (all.size() < frames && !HasFatalFailure()) {
      show(1);
      if (shown.empty()) break;
      all.push_back(shown.front());
      not_seen_yet.push_back(shown.front());
      std::erase_if(not_seen_yet, ask);
    }
    shown = std::move(all);
    return remembered;
  }

  /// A frame of nothing; whether it was wanted.
  bool blink() {
    FrameInfo frame;
    for (const Key key : display->poll()) keys.push_back(key);
    display->begin(frame);
    if (frame.should_render) {
      EXPECT_TRUE(renderer->draw({}, frame)) << renderer->failure();
    }
    display->end(frame);
    return frame.should_render;
  }

  OpenXrOptions options;
  bool validation = true;
  std::atomic<int> validation_messages{0};
  std::optional<OpenXrDisplay> display;
  std::optional<Renderer> renderer;
  ModelHandle ring;
  std::vector<FrameInfo> shown;
  std::vector<Duration> ahead, cpu;
  std::vector<Key> keys;  // from first to last
};

}  // namespace onestroke
