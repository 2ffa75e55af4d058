#include "scene/touch_gesture.h"

#include "hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace onestroke {
namespace {

constexpr double arm = 72;  // mm
constexpr std::array all_points{StickPoint::start, StickPoint::corner, StickPoint::end};

StickPoints points_of(const Pose& T) {
  return {T * Vec3{0, -arm, 0}, T.translation, T * Vec3{arm, 0, 0}};
}

/// The places of both sticks, as the tracker sees them.
class Seen {
 public:
  explicit Seen(std::uint32_t seed) : eyes_(seed) {}

  std::optional<std::array<StickPoints, 2>> see(const Pose& left, const Pose& right, double seconds) {
    const auto poses = eyes_.see(left, right, seconds);
    if (!poses[0] || !poses[1]) return std::nullopt;
    return std::array{points_of(*poses[0]), points_of(*poses[1])};
  }

 private:
  NoisyEyes eyes_;
};

constexpr double rate = 30;  // pictures a second
Time time_at(int frame) {
  return Time{} + Duration::from_seconds(frame / rate);
}

TEST(TouchGesture, FillsWhilePlacesAreHeldTogetherAndCountsOnce) {
  TouchGesture gesture;
  const Pose left{{}, {0, 0, 400}}, right{exp_so3({0, 0, std::numbers::pi}), {0, -2 * arm - 5, 400}};
  const std::optional sticks{std::array{points_of(left), points_of(right)}};
  int counted = 0;
  double before = 0;
  for (int frame = 0; frame < 60; ++frame) {
    if (const auto touch = gesture.update(sticks, time_at(frame))) {
      ++counted;
      EXPECT_EQ(*touch, (Touch{StickPoint::start, StickPoint::start}));
      EXPECT_NEAR(frame / rate, TouchGesture::hold.seconds(), 0.15);
    }
    EXPECT_TRUE(counted > 0 || gesture.progress() >= before);
    before = gesture.progress();
  }
  EXPECT_EQ(counted, 1);
  EXPECT_TRUE(gesture.held());
}

TEST(TouchGesture, CountsAgainOnlyAfterParting) {
  TouchGesture gesture;
  const Pose left{{}, {0, 0, 400}};
  int counted = 0, frame = 0;
  const auto hold_at = [&](double distance, int frames) {
    const Pose right{exp_so3({0, 0, 0.5 * std::numbers::pi}), {distance, 0, 400}};
    for (int i = 0; i < frames; ++i)
      if (gesture.update(std::array{points_of(left), points_of(right)}, time_at(frame++))) ++counted;
  };
  hold_at(22, 60);
  EXPECT_EQ(counted, 1);
  hold_at(48, 60);
  hold_at(22, 60);
  EXPECT_EQ(counted, 1);
  hold_at(70, 10);
  EXPECT_FALSE(gesture.held());
  hold_at(22, 60);
  EXPECT_EQ(counted, 2);
}

TEST(TouchGesture, OutlivesAShortGapAndNotALongOne) {
  for (const int gap : {5, 12}) {
    TouchGesture gesture;
    const Pose left{{}, {0, 0, 400}}, right{exp_so3({0, 0, 0.5 * std::numbers::pi}), {22, 0, 400}};
    const std::optional sticks{std::array{points_of(left), points_of(right)}};
    int frame = 0;
    for (; frame < 12; ++frame) gesture.update(sticks, time_at(frame));
    const double before = gesture.progress();
    EXPECT_GT(before, 0.3);
    for (int i = 0; i < gap; ++i) gesture.update(std::nullopt, time_at(frame++));
    gesture.update(sticks, time_at(frame));
    EXPECT_EQ(gesture.progress() >= before, gap == 5) << gap;
  }
}

TEST(TouchGesture, IsNotMadeInPassing) {
  TouchGesture gesture;
  const Pose left{{}, {0, 0, 400}};
  for (int frame = 0; frame < 300; ++frame) {
    // To and fro past the corner, never still.
    const double x = 55 * std::sin(2 * std::numbers::pi * frame / rate / 1.2);
    const Pose right{exp_so3({0, 0, 0.5 * std::numbers::pi}), {x, 12, 400}};
    EXPECT_FALSE(gesture.update(std::array{points_of(left), points_of(right)}, time_at(frame)));
  }
}

// A thousand times a touch is meant: the right hand brings a place of its stick to one of the left one's, a little off,
// and holds it there.
TEST(TouchGesture, IsFoundWhenItIsMeant) {
  std::mt19937 random(5);
  std::normal_distribution<double> miss(0, 2);
  std::uniform_real_distribution<double> turn(-0.6, 0.6);
  const auto seed = [&random] { return static_cast<std::uint32_t>(random()); };
  int found = 0, wrong = 0;
  constexpr int trials = 1000;
  for (int trial = 0; trial < trials; ++trial) {
    const auto pick = [&] { return all_points[random() % 3]; };
    const Touch meant{pick(), pick()};
    TouchGesture gesture;
    HandMotion left_hand(seed(), -1);
    Seen seen(seed());
    const Pose left = left_hand.at(0);
    // The sticks lie away from each other: the one that comes points where the other does not.
    const Vec3 outwards = -1 * normalized(points_of({{}, {}})[static_cast<std::size_t>(meant.left)] - Vec3{24, -24, 0});
    const Vec3 own = points_of({{}, {}})[static_cast<std::size_t>(meant.right)] - Vec3{24, -24, 0};
    const double angle = std::atan2(outwards.y, outwards.x) - std::atan2(own.y, own.x);
    const Quat facing = exp_so3({0, 0, angle});
    const Pose to{left.rotation * facing * exp_so3({turn(random), turn(random), turn(random)}), {}};
    const double gap = meant == Touch{StickPoint::corner, StickPoint::corner} ? 18 : 6;
    const Vec3 target = points_of(left)[static_cast<std::size_t>(meant.left)] + rotate(left.rotation, -gap * outwards) +
                        Vec3{miss(random), miss(random), miss(random)};
    const Vec3 place = target - points_of(to)[static_cast<std::size_t>(meant.right)];
    bool done = false;
    for (int frame = 0; frame < 3.5 * rate && !done; ++frame) {
      const double u = std::min(frame / rate / 0.9, 1.0), s = u * u * u * (10 + u * (6 * u - 15));
      const double t = frame / rate;
      const Vec3 shake{std::sin(47 * t), std::sin(53 * t + 1), std::sin(61 * t + 2)};
      const Pose right{to.rotation, place + (1 - s) * Vec3{180, 40, 30} + 0.7 * shake};
      if (const auto touch = gesture.update(seen.see(left, right, t), time_at(frame))) {
        done = true;
        ++(*touch == meant ? found : wrong);
      }
    }
  }
  std::printf("touches: %d of %d found, %d taken for another\n", found, trials, wrong);
  EXPECT_GE(found, trials * 99 / 100);
  EXPECT_LE(wrong, trials / 200);
}

TEST(TouchGesture, IsNotMadeByHandsThatMoveFreely) {
  int made = 0;
  constexpr int sessions = 100, seconds = 600;
  for (int session = 0; session < sessions; ++session) {
    TouchGesture gesture;
    const auto seed = static_cast<std::uint32_t>(100 + 3 * session);
    HandMotion left(seed, -1), right(seed + 1, 1);
    Seen seen(seed + 2);
    for (int frame = 0; frame < seconds * rate; ++frame) {
      const double t = frame / rate;
      if (gesture.update(seen.see(left.at(t), right.at(t), t), time_at(frame))) ++made;
    }
  }
  std::printf("free motion: %d touches in %d times 10 minutes\n", made, sessions);
  EXPECT_LT(made, sessions);
}

}  // namespace
}  // namespace onestroke
