#include "app/frame_meter.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

constexpr Time start{1'000'000'000};

FrameRecord record_of(double cost_ms) {
  FrameRecord record;
  record.cost = Duration::from_ms(cost_ms);
  return record;
}

TEST(FrameMeter, CountsPicturesAndFrames) {
  FrameMeter meter;
  const FrameRecord record = record_of(8);
  // Two seconds of 60 frames a second, a new picture in every second one.
  for (int i = 0; i <= 120; ++i)
    meter.update(
        {.record = record, .new_picture = i % 2 == 0, .left_out = 3, .now = start + Duration::from_seconds(i / 60.0)});
  const FrameFigures& figures = meter.figures();
  EXPECT_NEAR(figures.pictures_a_second, 30, 0.5);
  EXPECT_NEAR(figures.frames_a_second, 60, 0.5);
  EXPECT_NEAR(figures.tracker_ms, 8, 0.1);
  EXPECT_EQ(figures.left_out, 3u);
  EXPECT_FALSE(figures.latency);
}

TEST(FrameMeter, TellsTheMedianAgeOfTheLastSecond) {
  FrameMeter meter;
  const FrameRecord record;
  const auto frames = [&](int from, int to, auto&& age_ms) {
    for (int i = from; i < to; ++i)
      meter.update({.record = record,
                    .latency = Latency{.tracked = {}, .drawn = {}, .seen = Duration::from_ms(age_ms(i))},
                    .now = start + Duration::from_seconds(i / 60.0)});
  };
  // One frame in ten is far too late, which a mean would tell of.
  frames(0, 91, [](int i) { return i % 10 == 0 ? 400 : 20; });
  ASSERT_TRUE(meter.figures().latency);
  EXPECT_EQ(meter.figures().latency->seen.ms(), 20);
  // What is older than a second counts no more.
  frames(91, 182, [](int) { return 45; });
  EXPECT_EQ(meter.figures().latency->seen.ms(), 45);
}

TEST(FrameMeter, KeepsUpWithAFastDisplay) {
  FrameMeter meter;
  const FrameRecord record;
  for (int i = 0; i <= 3000; ++i)
    meter.update({.record = record,
                  .latency = Latency{.tracked = {}, .drawn = {}, .seen = Duration::from_ms(i < 1500 ? 1 : 7)},
                  .now = start + Duration::from_seconds(i / 1000.0)});
  EXPECT_EQ(meter.figures().latency->seen.ms(), 7);
  EXPECT_NEAR(meter.figures().frames_a_second, 1000, 3);
}

TEST(FrameMeter, TellsNoAgeWhereNoneIsKnownAnyMore) {
  FrameMeter meter;
  const FrameRecord record;
  meter.update(
      {.record = record, .latency = Latency{.tracked = {}, .drawn = {}, .seen = Duration::from_ms(5)}, .now = start});
  meter.update({.record = record, .now = start + Duration::from_ms(600)});
  EXPECT_TRUE(meter.figures().latency);
  meter.update({.record = record, .now = start + Duration::from_ms(1200)});
  EXPECT_FALSE(meter.figures().latency);
}

}  // namespace
}  // namespace onestroke
