#include "core/pose_history.h"

#include "core/error.h"
#include "random_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace onestroke {
namespace {

using Kind = PoseHistory::Kind;

constexpr Time at_ms(double ms) {
  return Time{} + Duration::from_ms(ms);
}

/// A screw motion whose pose at any time is known: constant angular and linear velocity.
struct Motion {
  Pose start;
  Velocity velocity;

  Pose at(Time t) const { return advance(start, velocity, t - Time{}); }
};

Motion screw() {
  test::RandomPose random;
  return {random.pose(), {random.turn(3), random.vector(200)}};
}

void expect_pose(const Pose& a, const Pose& b, double tolerance = 1e-8) {
  EXPECT_NEAR(norm(a.translation - b.translation), 0, tolerance);
  EXPECT_NEAR(angle_between(a.rotation, b.rotation), 0, tolerance);
}

void expect_velocity(const Velocity& a, const Velocity& b, double tolerance = 1e-6) {
  EXPECT_NEAR(norm(a.linear - b.linear), 0, tolerance);
  EXPECT_NEAR(norm(a.angular - b.angular), 0, tolerance);
}

TEST(PoseHistory, KnowsNothingWhenEmpty) {
  const PoseHistory history(4);
  EXPECT_EQ(history.get(at_ms(5)).kind, Kind::none);
  EXPECT_THROW(PoseHistory(0), Error);
}

TEST(PoseHistory, SaysHowItKnows) {
  const Motion motion = screw();
  PoseHistory history(8, Duration::from_ms(50));
  for (const double ms : {10, 20, 30}) history.add(at_ms(ms), motion.at(at_ms(ms)));
  const auto expect = [&](double ms, Kind kind) {
    const PoseHistory::Answer answer = history.get(at_ms(ms));
    EXPECT_EQ(answer.kind, kind) << ms;
    expect_pose(answer.pose, motion.at(at_ms(ms)));
    expect_velocity(answer.velocity, motion.velocity);
  };
  for (const double ms : {10, 20, 30}) expect(ms, Kind::exact);
  for (const double ms : {10.5, 15.0, 29.999}) expect(ms, Kind::interpolated);
  for (const double ms : {30.001, 45.0, 80.0}) expect(ms, Kind::predicted);
}

TEST(PoseHistory, OffersTheNearestItKnowsOutsideItsReach) {
  const Motion motion = screw();
  PoseHistory history(8, Duration::from_ms(50));
  for (const double ms : {10, 20}) history.add(at_ms(ms), motion.at(at_ms(ms)));
  EXPECT_EQ(history.get(at_ms(9)).kind, Kind::none);
  expect_pose(history.get(at_ms(9)).pose, motion.at(at_ms(10)));
  EXPECT_EQ(history.get(at_ms(500)).kind, Kind::none);
  expect_pose(history.get(at_ms(500)).pose, motion.at(at_ms(70)));
}

TEST(PoseHistory, ASingleSampleStandsStill) {
  PoseHistory history(4);
  history.add(at_ms(10), screw().start);
  EXPECT_EQ(history.get(at_ms(20)).kind, Kind::predicted);
  expect_pose(history.get(at_ms(20)).pose, screw().start);
  expect_velocity(history.get(at_ms(20)).velocity, {});
}

TEST(PoseHistory, PredictsByTheVelocityItIsGiven) {
  const Motion motion = screw();
  PoseHistory history(4);
  history.add(at_ms(10), motion.at(at_ms(10)), motion.velocity);
  expect_pose(history.get(at_ms(60)).pose, motion.at(at_ms(60)));
  history.add(at_ms(5), {});
  expect_velocity(history.get(at_ms(10)).velocity, motion.velocity);
}

TEST(PoseHistory, OrderOfArrivalDoesNotMatter) {
  const Motion motion = screw();
  std::vector<int> order(16);
  for (int i = 0; i < 16; ++i) order[static_cast<std::size_t>(i)] = i;
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    PoseHistory history(16);
    for (const int i : order) history.add(at_ms(10 * i), motion.at(at_ms(10 * i)));
    ASSERT_EQ(history.size(), 16u);
    EXPECT_EQ(history.newest(), at_ms(150));
    for (int i = 0; i < 16; ++i) EXPECT_EQ(history.get(at_ms(10 * i)).kind, Kind::exact);
    for (double ms = 2.5; ms < 200; ms += 5) expect_pose(history.get(at_ms(ms)).pose, motion.at(at_ms(ms)));
  }
}

TEST(PoseHistory, KeepsTheNewest) {
  PoseHistory history(4);
  for (int i = 0; i < 100; ++i) history.add(at_ms(i), {{}, {double(i), 0, 0}});
  EXPECT_EQ(history.size(), 4u);
  EXPECT_EQ(history.get(at_ms(96)).kind, Kind::exact);
  EXPECT_EQ(history.get(at_ms(95)).kind, Kind::none);
  EXPECT_EQ(history.get(at_ms(98.5)).pose.translation.x, 98.5);
}

TEST(PoseHistory, ALateSampleOfAFullHistoryPushesOutTheOldest) {
  PoseHistory history(4);
  for (const int i : {0, 2, 4, 6}) history.add(at_ms(i), {{}, {double(i), 0, 0}});
  history.add(at_ms(3), {{}, {30, 0, 0}});
  EXPECT_EQ(history.get(at_ms(0)).kind, Kind::none);
  EXPECT_EQ(history.get(at_ms(3)).pose.translation.x, 30);
  for (const int i : {2, 4, 6}) EXPECT_EQ(history.get(at_ms(i)).pose.translation.x, i);
  history.add(at_ms(1), {{}, {10, 0, 0}});
  EXPECT_EQ(history.size(), 4u);
  EXPECT_EQ(history.get(at_ms(1)).kind, Kind::none);
}

TEST(PoseHistory, ASampleOfAKnownTimeTakesItsPlace) {
  PoseHistory history(4);
  history.add(at_ms(1), {{}, {1, 0, 0}});
  history.add(at_ms(2), {{}, {2, 0, 0}});
  history.add(at_ms(1), {{}, {5, 0, 0}});
  EXPECT_EQ(history.size(), 2u);
  EXPECT_EQ(history.get(at_ms(1)).pose.translation.x, 5);
  history.clear();
  EXPECT_TRUE(history.empty());
  EXPECT_EQ(history.get(at_ms(1)).kind, Kind::none);
}

TEST(Velocity, AdvanceUndoesVelocityBetween) {
  test::RandomPose random;
  for (int i = 0; i < 1000; ++i) {
    const Pose a = random.pose(), b = random.pose();
    const Duration span = Duration::from_ms(random.uniform(1, 100));
    const Pose reached = advance(a, velocity_between(a, b, span), span);
    EXPECT_NEAR(norm(reached.translation - b.translation), 0, 1e-9);
    EXPECT_NEAR(angle_between(reached.rotation, b.rotation), 0, 1e-12);
  }
}

}  // namespace
}  // namespace onestroke
