// Poses and velocities from the rod's edges in rendered pictures.

#include "tracking/line_fit.h"

#include "view_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

namespace onestroke::test {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr std::array<LineOptions, 3> passes{{{8}, {5}, {4}}};

Vector6 error_of(const EigenPose& found, const Pose& truth) {
  const Vec3 turn = log_so3(from_eigen(found).rotation * truth.rotation.conjugate());
  Vector6 e;
  e << to_eigen(turn), found.t - to_eigen(truth.translation);
  return e;
}

LineFit fit(const Shot& shot, const RodModel& rod, const Pose& truth, const Pose& start, const RowClock& clock = {}) {
  LineFitter fitter;
  return fitter.fit({shot.view(), shot.intrinsics, clock}, rod, inks_at(shot, rod, truth), {to_eigen(start)}, {},
                    passes);
}

TEST(LineFit, ComesBackFromADisturbedStart) {
  for_disturbed_starts([](const RodModel& rod, const Shot& shot, const Pose& truth, const Pose& start) {
    const LineFit f = fit(shot, rod, truth, start);
    ASSERT_TRUE(f.settled());
    EXPECT_LT(turn_between(from_eigen(f.motion.pose), truth), 0.3);
    EXPECT_LT(shift_between(from_eigen(f.motion.pose), truth), 1e-3);
    EXPECT_LT(f.rms, 0.3);
    EXPECT_GT(f.edges, 20);
  });
}

// The sum of squares of six normalised errors has a mean of 6; 95 % of the means of 24 such sums lie within 6 +- 1.4.
TEST(LineFit, CovarianceIsHonest) {
  RandomPose random;
  constexpr int count = 24;
  double mean = 0;
  int beyond = 0;
  for (int i = 0; i < count; ++i) {
    const MarkerSpec marker = angle_marker(2, i % 2 ? 8 : 0);
    const RodModel rod(marker);
    const Pose truth = random_view(random);
    const Shot shot = shoot(marker, truth, {.noise = 2, .seed = static_cast<std::uint64_t>(300 + i)});
    const LineFit f = fit(shot, rod, truth, truth);
    ASSERT_TRUE(f.valid);
    const Matrix6d covariance = f.pose_covariance();
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(covariance).eigenvalues().minCoeff(), 0);
    const Vector6 e = error_of(f.motion.pose, truth);
    const double square = e.dot(covariance.ldlt().solve(e));
    mean += square / count;
    beyond += square > 12.6;  // 5 % of a chi-square distribution of 6 degrees of freedom.
  }
  EXPECT_GT(mean, 3);
  EXPECT_LT(mean, 12);
  EXPECT_LE(beyond, 7);
}

TEST(LineFit, FingersDoNotDrawItAway) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  for (int i = 0; i < 6; ++i) {
    const Pose truth = random_view(random);
    Shot shot = shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)});
    const Inks inks = inks_at(shot, rod, truth);
    Vec2d middle;
    ASSERT_TRUE(project(shot.intrinsics, to_eigen(truth) * rod.middle(8).centre, middle));
    cover(shot, middle, 14, {196, 148, 120});
    LineFitter fitter;
    const LineFit f = fitter.fit({shot.view(), shot.intrinsics, {}}, rod, inks,
                                 {to_eigen(disturbed(truth, random, 1, 1))}, {}, passes);
    ASSERT_TRUE(f.valid);
    EXPECT_LT(turn_between(from_eigen(f.motion.pose), truth), 0.5);
    EXPECT_LT(f.shown, f.expected);
  }
}

// The mean of the outline's standard deviations, pixels.
double outline_sigma(const Shot& shot, const RodModel& rod, const Inks& inks, const Pose& truth) {
  LineSet set;
  measure_lines({shot.view(), shot.intrinsics, {}}, rod, inks, {to_eigen(truth)}, {}, set);
  double sum = 0;
  int count = 0;
  for (const LineMeasurement& m : set.lines) {
    if (m.ring()) continue;
    sum += m.sigma;
    ++count;
  }
  EXPECT_GT(count, 40);
  return sum / count;
}

TEST(LineFit, WhatChangesBehindTheRodLeavesItsOutlineUnsure) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose truth = random_view(random);
  Shot shot = shoot(marker, truth, {.noise = 0});
  const Inks inks = inks_at(shot, rod, truth);
  const double even = outline_sigma(shot, rod, inks, truth);
  // Light that grows by four levels a pixel, again and again, and falls back.
  for (int y = 0; y < shot.image.height; ++y)
    for (int x = 0; x < 3 * shot.image.width; ++x) {
      std::uint8_t& v = shot.image.rgb[static_cast<std::size_t>(3 * y * shot.image.width + x)];
      v = static_cast<std::uint8_t>(std::min(255, v + 4 * std::abs((y + x / 3) % 32 - 16)));
    }
  EXPECT_GT(outline_sigma(shot, rod, inks, truth), 1.2 * even);
}

TEST(MotionPrior, TakesTheMeanOfWhatIsTold) {
  const Matrix6d sure = 1e-6 * Matrix6d::Identity();
  const EigenPose here = to_eigen(about_middle(exp_so3({0.3, 0.4, 0}), {0, 0, 350}));
  Vector6 off;
  off << 2e-3, 0, 0, 0, 0.1, 0;
  MotionPrior prior;
  prior.add(here, sure);
  prior.add(perturbed(here, off), sure / 3);
  EXPECT_LT((perturbation(here, prior.pose.value()) - 0.75 * off).norm(), 1e-6);
  EXPECT_LT((prior.pose_information - 4e6 * Matrix6d::Identity()).norm(), 1);
}

// One arm is covered: of the roll about the other, edges tell nothing.
TEST(LineFit, WhatEdgesDoNotTellIsWhatIsKnown) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    const Pose truth = random_view(random);
    Shot shot = shoot(marker, truth, {.seed = static_cast<std::uint64_t>(i)});
    const Inks inks = inks_at(shot, rod, truth);
    for (int c = 15; c < rod.cell_count(); ++c) {
      Vec2d middle;
      ASSERT_TRUE(project(shot.intrinsics, to_eigen(truth) * rod.middle(c).centre, middle));
      cover(shot, middle, 10, {196, 148, 120});
    }
    constexpr double turn_sigma = 0.01, shift_sigma = 0.5;
    Matrix6d covariance = Matrix6d::Zero();
    covariance.diagonal().head<3>().setConstant(turn_sigma * turn_sigma);
    covariance.diagonal().tail<3>().setConstant(shift_sigma * shift_sigma);
    const EigenPose expected = to_eigen(disturbed(truth, random, turn_sigma / radian, shift_sigma));
    MotionPrior prior;
    prior.add(expected, covariance);
    LineFitter fitter;
    const LineFit f = fitter.fit({shot.view(), shot.intrinsics, {}}, rod, inks, {expected}, prior, passes);
    ASSERT_TRUE(f.settled());
    const Vector6 e = error_of(f.motion.pose, truth);
    EXPECT_LT(e.head<3>().norm(), 4 * turn_sigma);
    EXPECT_LT(e.dot(f.pose_covariance().ldlt().solve(e)), 40);
    const Vec3d arm = to_eigen(truth).R * rod.middle(4).tangent;
    const Mat3d turn = f.pose_covariance().topLeftCorner<3, 3>();
    EXPECT_GT(std::sqrt(arm.dot(turn * arm)), 0.7 * turn_sigma) << "the roll is no surer than it was known";
    EXPECT_LT(turn.trace() - arm.dot(turn * arm), turn_sigma * turn_sigma / 2) << "the arm's direction is";
  }
}

TEST(LineFit, WhereNothingIsNothingIsFound) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose truth = about_middle(exp_so3({0.3, 0.4, 0}), {0, 0, 350});
  const Shot shot = shoot(marker, truth), empty = shoot(std::vector<Placed>{});
  LineFitter fitter;
  const LineFit f =
      fitter.fit({empty.view(), empty.intrinsics, {}}, rod, inks_at(shot, rod, truth), {to_eigen(truth)}, {}, passes);
  EXPECT_FALSE(f.valid);
  EXPECT_FALSE(f.settled());
}

/// A marker that turns about an upright axis through its middle while the rows of a picture of the paper's camera are
/// exposed; the truth is at the middle row.
struct Turntable {
  static constexpr double rate = 4;  // rad/s
  MarkerSpec marker = angle_marker(2);
  Rod rod{marker};
  Exposure exposure;
  Shot shot;
  Pose truth;

  explicit Turntable(double angle) {
    exposure.length = Duration::from_ms(2);
    exposure.readout = Duration::from_ms(50);
    const double span = (exposure.length + exposure.readout).seconds();
    const auto at = [&](double t) {
      return about_middle(exp_so3({0, angle + rate * t, 0}) * exp_so3({0, 0, 0.7}), {0, 0, 330});
    };
    truth = at(0);
    SyntheticFrame frame;
    frame.width = 1600;
    frame.height = 1200;
    frame.intrinsics = Intrinsics::from_fov(frame.width, frame.height, 35 * radian);
    frame.markers.push_back(
        {&rod, PosePath(std::array{at(-span / 2), at(-span / 4), at(0), at(span / 4), at(span / 2)})});
    frame.effects.exposure = exposure.length;
    frame.effects.readout = exposure.readout;
    frame.effects.noise = 1.5;
    frame.effects.blur = 0.5;
    shot = {frame.intrinsics, render_synthetic(frame)};
  }
};

TEST(LineFit, OnePictureOfARollingShutterTellsPoseAndVelocity) {
  for (const double angle : {-0.6, 0.1, 0.5}) {
    SCOPED_TRACE(angle);
    const Turntable t(angle);
    const RodModel rod(t.marker);
    const RowClock clock(t.exposure, 1200);
    const LineFit f = fit(t.shot, rod, t.truth, t.truth, clock);
    ASSERT_TRUE(f.settled());
    EXPECT_LT(turn_between(from_eigen(f.motion.pose), t.truth), 0.3);
    EXPECT_LT((f.motion.angular - Vec3d(0, Turntable::rate, 0)).norm(), 0.4);
    EXPECT_LT(std::sqrt(f.covariance.block(6, 6, 3, 3).trace()), 1);
    // Taken for a global one's, the picture shows another pose.
    const LineFit still = fit(t.shot, rod, t.truth, t.truth);
    EXPECT_GT(turn_between(from_eigen(still.motion.pose), t.truth), 0.3);
  }
}

}  // namespace
}  // namespace onestroke::test
