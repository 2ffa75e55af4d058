// What hands and heads mean, without a headset.
#include "display/pinch_tap.h"
#include "display/recentring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace onestroke {
namespace {

constexpr double frame_ms = 1000.0 / 72;

/// So long so far apart, mm; nothing where the hand is not seen.
struct Step {
  double ms = 0;
  std::optional<double> apart_mm{};
};

int taps_in(const std::vector<Step>& steps) {
  PinchTap tap;
  int taps = 0;
  double now = 0;
  for (const Step& step : steps)
    for (double t = 0; t < step.ms; t += frame_ms, now += frame_ms)
      taps += tap.update(step.apart_mm, Time{} + Duration::from_ms(now));
  return taps;
}

TEST(PinchTap, IsOpenTogetherAndOpenAgain) {
  EXPECT_EQ(taps_in({{500, 70}, {150, 10}, {100, 70}}), 1);
  EXPECT_EQ(taps_in({{500, 70}, {150, 10}, {400, 70}, {200, 12}, {400, 70}}), 2);
  EXPECT_EQ(taps_in({{500, 70}, {150, 10}}), 0) << "it is over when the hand is open";
}

TEST(PinchTap, IsNotAHandWithAStick) {
  EXPECT_EQ(taps_in({{60000, 9}}), 0) << "holds it";
  EXPECT_EQ(taps_in({{1000, 70}, {5000, 9}}), 0) << "takes it up";
  EXPECT_EQ(taps_in({{5000, 9}, {1000, 70}}), 0) << "lays it down";
  EXPECT_EQ(taps_in({{1000, 70}, {5000, 9}, {1000, 70}}), 0) << "holds it for a while";
  EXPECT_EQ(taps_in({{1000, 9}, {100, 60}, {150, 9}, {1000, 60}}), 0) << "takes another hold of it";
}

TEST(PinchTap, ForgivesNoGap) {
  EXPECT_EQ(taps_in({{500, 70}, {100, 10}, {50, {}}, {50, 10}, {300, 70}}), 0);
  EXPECT_EQ(taps_in({{500, {}}, {100, 10}, {300, 70}}), 0);
}

TEST(PinchTap, DoesNotFlickerWhereFingersAreHalfClosed) {
  std::mt19937 random(3);
  std::normal_distribution<double> tremor(29, 3.5);
  PinchTap tap;
  tap.update(70, Time{});
  for (int i = 1; i < 20000; ++i)
    EXPECT_FALSE(tap.update(tremor(random), Time{} + Duration::from_ms(frame_ms * i))) << i;
}

TEST(HandTaps, TellWhichFingerItWas) {
  const auto tap_of = [](HandPinch together) {
    HandTaps taps;
    std::vector<HandTaps::Tap> found;
    double now = 0;
    for (const HandPinch& hand : {HandPinch{70, 75}, together, HandPinch{70, 75}})
      for (double t = 0; t < 300; t += frame_ms, now += frame_ms)
        if (const auto tap = taps.update(hand, Time{} + Duration::from_ms(now)); tap != HandTaps::Tap::none)
          found.push_back(tap);
    return found;
  };
  using enum HandTaps::Tap;
  EXPECT_EQ(tap_of({10, 60}), std::vector{forefinger});
  EXPECT_EQ(tap_of({45, 11}), std::vector{middle_finger});
  EXPECT_EQ(tap_of({10, 12}), std::vector{forefinger});
  EXPECT_TRUE(tap_of({60, 65}).empty());
}

TEST(Recentring, KeepsTheHeadsPlaceAndWhereItIsTurned) {
  const Pose head{exp_so3({0, 0.7, 0}) * exp_so3({0.5, 0, 0}) * exp_so3({0, 0, 0.4}), {10, 20, 30}};
  const Pose found = upright(head);
  EXPECT_NEAR(norm(found.translation - head.translation), 0, 1e-12);
  EXPECT_NEAR(angle_between(found.rotation, exp_so3({0, 0.7, 0})), 0, 1e-9);
}

TEST(Recentring, IsUprightAlwaysAndAheadAlsoWhereTheHeadLooksUpOrDown) {
  for (const double nod : {-1.55, -1.4, -0.5, 0.5, 1.4, 1.55}) {
    const Pose found = upright({exp_so3({0, -2, 0}) * exp_so3({nod, 0, 0}), {}});
    EXPECT_NEAR(norm(rotate(found.rotation, {0, 1, 0}) - Vec3{0, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(angle_between(found.rotation, exp_so3({0, -2, 0})), 0, 1e-9) << nod;
  }
}

}  // namespace
}  // namespace onestroke
