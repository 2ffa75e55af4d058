#include "tracking/follower.h"

#include "marker_fixture.h"

#include <gtest/gtest.h>

namespace onestroke::test {
namespace {

using Phase = Follower::Phase;

Time at_ms(std::int64_t ms) {
  return {ms * 1'000'000};
}

Matrix6d unit_covariance() {
  return 1e-6 * Matrix6d::Identity();
}

/// Turns at 1 rad/s about z and moves at 100 mm/s along x.
Pose moving(Time t) {
  const double s = static_cast<double>(t.ns) * 1e-9;
  return {exp_so3({0, 0, s}), {100 * s, 20, 400}};
}

Follower followed(std::initializer_list<std::int64_t> times) {
  Follower f;
  for (const std::int64_t ms : times) f.measured(at_ms(ms), {moving(at_ms(ms)), unit_covariance()}, {});
  return f;
}

TEST(Follower, KnowsNothingAtFirst) {
  const Follower f;
  EXPECT_EQ(f.phase(), Phase::unknown);
  EXPECT_FALSE(f.ever_seen());
}

TEST(Follower, OneMeasurementStandsStill) {
  const Follower f = followed({100});
  EXPECT_EQ(f.phase(), Phase::followed);
  EXPECT_EQ(norm(f.velocity().linear), 0);
  EXPECT_LT(norm(f.predict(at_ms(200)).translation - moving(at_ms(100)).translation), 1e-9);
}

TEST(Follower, PredictsConstantVelocity) {
  const Follower f = followed({100, 133});
  EXPECT_NEAR(f.velocity().linear.x, 100, 1e-6);
  EXPECT_NEAR(f.velocity().angular.z, 1, 1e-6);
  const Pose predicted = f.predict(at_ms(233)), truth = moving(at_ms(233));
  EXPECT_LT(angle_between(predicted.rotation, truth.rotation), 1e-6);
  EXPECT_LT(norm(predicted.translation - truth.translation), 1e-6);
}

TEST(Follower, PredictsAnAccelerationThatDiesAway) {
  Follower f;
  const auto at = [](double s) { return Pose{{}, {100 * s + 900 * s * s, 20, 400}}; };
  for (const int ms : {0, 33, 66, 99}) f.measured(at_ms(ms), {at(ms * 1e-3), unit_covariance()}, {});
  const double speed = 100 + 2 * 900 * 0.099, steady = 900 * 0.033 * 0.033;
  EXPECT_NEAR(f.velocity().linear.x, speed, 0.02 * speed);
  EXPECT_LT(norm(f.predict(at_ms(132)).translation - at(0.132).translation), 0.5 * steady)
      << "better than a constant velocity";
}

TEST(Follower, WhatMeasurementsErrByIsNoAcceleration) {
  Follower f;
  const Matrix6d loose = 4 * Matrix6d::Identity();
  for (const int ms : {0, 33, 66, 99}) f.measured(at_ms(ms), {{{}, {ms % 2 ? 1.0 : -1.0, 0, 400}}, loose}, {});
  EXPECT_LT(norm(f.predict(at_ms(132)).translation - Vec3{0, 0, 400}), 5);
}

TEST(Follower, AVelocityThatOnePictureToldIsTaken) {
  Follower f;
  const Velocity told{{0, 2, 0}, {50, 0, 0}};
  f.measured(at_ms(0), {moving(at_ms(0)), unit_covariance()}, {}, &told);
  EXPECT_EQ(f.velocity().angular.y, 2);
  EXPECT_NEAR(f.predict(at_ms(100)).translation.x, moving(at_ms(0)).translation.x + 5, 1e-9);
}

TEST(Follower, BelievesWhatComesTwice) {
  Follower f = followed({0, 33, 66});
  const Pose elsewhere{exp_so3({0, 2, 0}), {-200, 20, 400}};
  EXPECT_FALSE(f.plausible(at_ms(99), elsewhere));
  EXPECT_TRUE(f.plausible(at_ms(132), elsewhere));
}

TEST(Follower, AVelocityIsNotTakenAcrossALongGap) {
  const Follower f = followed({0, 600});
  EXPECT_EQ(norm(f.velocity().linear), 0);
  EXPECT_EQ(norm(f.velocity().angular), 0);
}

TEST(Follower, TwoMeasurementsOfOneTimeGiveNoVelocity) {
  const Follower f = followed({50, 50});
  EXPECT_EQ(norm(f.velocity().linear), 0);
}

TEST(Follower, PassesFromPredictedToLostToForgotten) {
  TrackerOptions options;
  options.predict_for = Duration::from_ms(200);
  options.report_lost_for = Duration::from_ms(300);
  Follower f = followed({0, 33});
  f.missed(at_ms(33 + 200), options);
  EXPECT_EQ(f.phase(), Phase::followed) << "carried on to the end of its time";
  f.missed(at_ms(33 + 201), options);
  EXPECT_EQ(f.phase(), Phase::lost);
  f.missed(at_ms(33 + 500), options);
  EXPECT_EQ(f.phase(), Phase::lost);
  f.missed(at_ms(33 + 501), options);
  EXPECT_EQ(f.phase(), Phase::unknown);
  EXPECT_FALSE(f.ever_seen());
}

TEST(Follower, AMeasurementEndsTheLoss) {
  TrackerOptions options;
  Follower f = followed({0, 33});
  f.missed(at_ms(400), options);
  ASSERT_EQ(f.phase(), Phase::lost);
  f.measured(at_ms(430), {moving(at_ms(430)), unit_covariance()}, {});
  EXPECT_EQ(f.phase(), Phase::followed);
  EXPECT_EQ(norm(f.velocity().linear), 0) << "what it did while it was lost is not known";
}

TEST(Follower, WhatWasNeverSeenIsNotMissed) {
  Follower f;
  f.missed(at_ms(5000), {});
  EXPECT_EQ(f.phase(), Phase::unknown);
}

TEST(Follower, PredictionsGrowUncertainWithTime) {
  const Follower f = followed({0, 33});
  const auto now = f.predicted_covariance(at_ms(33)), soon = f.predicted_covariance(at_ms(66)),
             later = f.predicted_covariance(at_ms(133));
  EXPECT_EQ(now, unit_covariance());
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(soon(i, i), now(i, i));
    EXPECT_GT(later(i, i), soon(i, i));
  }
}

// What was expected is no measurement when it comes back.
TEST(Follower, IsNoSurerForWhatItExpectedItself) {
  Follower f = followed({0, 33, 66, 99, 132});
  const double before = f.expectation(at_ms(165)).covariance(0, 0);
  for (int ms = 165; ms < 300; ms += 33) {
    PoseMeasurement same = f.expectation(at_ms(ms));
    same.as_expected = true;
    f.measured(at_ms(ms), same, {});
  }
  EXPECT_GT(f.expectation(at_ms(330)).covariance(0, 0), 9 * before);
}

}  // namespace
}  // namespace onestroke::test
