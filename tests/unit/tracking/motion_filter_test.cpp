#include "tracking/motion_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke::test {
namespace {

constexpr double picture = 1.0 / 30;

Matrix6d sure() {
  return 1e-8 * Matrix6d::Identity();
}

// Turns about x and y and moves along z, at constant rates.
Pose steady(double s) {
  return {exp_so3({1.5 * s, 0.5 * s, 0}), {5, -20, 400 + 80 * s}};
}

// A hand that swings at 2 Hz.
Pose swinging(double s) {
  const double phase = 4 * std::acos(-1.0) * s;
  return {exp_so3({0.2 * std::sin(phase), 0, 0}), {15 * std::cos(phase), 8 * std::sin(phase), 450}};
}

double turn(const Pose& a, const Pose& b) {
  return norm(log_so3(a.rotation * b.rotation.conjugate()));
}

TEST(MotionFilter, KnowsNoMotionOfOnePose) {
  MotionFilter f;
  f.start(steady(0), sure(), nullptr);
  EXPECT_FALSE(f.moving());
  EXPECT_EQ(turn(f.predict(picture), steady(0)), 0);
}

TEST(MotionFilter, GoesOnAsTwoPosesTell) {
  MotionFilter f;
  f.start(steady(0), sure(), nullptr);
  f.add(steady(picture), sure(), picture);
  EXPECT_TRUE(f.moving());
  EXPECT_LT(turn(f.predict(picture), steady(2 * picture)), 1e-4);
  EXPECT_LT(norm(f.predict(picture).translation - steady(2 * picture).translation), 1e-3);
}

TEST(MotionFilter, PredictsASwingBetterThanAConstantVelocity) {
  MotionFilter f;
  f.start(swinging(0), sure(), nullptr);
  double off = 0, steadily = 0;
  for (int i = 1; i < 60; ++i) {
    f.add(swinging(i * picture), sure(), picture);
    if (i < 4) continue;
    const Pose next = swinging((i + 1) * picture), now = swinging(i * picture), before = swinging((i - 1) * picture);
    off += turn(f.predict(picture), next);
    steadily += turn({now.rotation * before.rotation.conjugate() * now.rotation, {}}, next);
  }
  EXPECT_LT(off, 0.6 * steadily);
}

TEST(MotionFilter, GoesOnWhereAPoseTellsNothing) {
  MotionFilter f;
  f.start(steady(0), sure(), nullptr);
  for (int i = 1; i < 10; ++i) f.add(steady(i * picture), sure(), picture);
  Matrix6d vague = sure();
  vague.topLeftCorner<3, 3>().diagonal().setConstant(0.01);
  for (int i = 10; i < 14; ++i) {
    Pose wrong = steady(i * picture);
    wrong.rotation = exp_so3({i % 2 ? 0.1 : -0.1, 0, 0}) * wrong.rotation;
    f.add(wrong, vague, picture);
  }
  EXPECT_LT(turn(f.predict(picture), steady(14 * picture)), 0.03) << "a third of what the poses are off by";
  EXPECT_LT(norm(f.predict(picture).translation - steady(14 * picture).translation), 0.01);
}

TEST(MotionFilter, PredictsNothingWildAfterAStop) {
  MotionFilter f;
  f.start(steady(0), sure(), nullptr);
  for (int i = 1; i < 10; ++i) f.add(steady(i * picture), sure(), picture);
  const Pose stopped = steady(9 * picture);
  for (int i = 0; i < 4; ++i) f.add(stopped, sure(), picture);
  EXPECT_LT(turn(f.predict(0.2), stopped), 0.05);
}

TEST(MotionFilter, TakesAVelocityThatIsTold) {
  MotionFilter f;
  const Velocity told{{1.5, 0.5, 0}, {0, 0, 80}};
  f.start(steady(0), sure(), &told);
  EXPECT_TRUE(f.moving());
  EXPECT_LT(turn(f.predict(picture), steady(picture)), 1e-8);
}

}  // namespace
}  // namespace onestroke::test
