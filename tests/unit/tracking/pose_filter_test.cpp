#include "tracking/pose_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace onestroke::test {
namespace {

constexpr double turn_sigma = 1e-3, shift_sigma = 0.05;

// Measurement errors of which a share of the variance is the same in all pictures while nothing moves.
class Noise {
 public:
  static constexpr double in_common = 0.9;

  explicit Noise(double scale = 1) : scale_(scale) {}

  Matrix6d covariance() const {
    Matrix6d c = Matrix6d::Zero();
    c.diagonal().head<3>().setConstant(std::pow(scale_ * turn_sigma, 2));
    c.diagonal().tail<3>().setConstant(std::pow(scale_ * shift_sigma, 2));
    return c;
  }
  PoseMeasurement still(const Pose& truth) { return off(truth, std::sqrt(1 - in_common)); }
  PoseMeasurement moving(const Pose& truth) { return off(truth, 1); }

 private:
  PoseMeasurement off(const Pose& truth, double share) {
    return {{normalized(exp_so3(vector(share * turn_sigma)) * truth.rotation),
             truth.translation + vector(share * shift_sigma)},
            covariance()};
  }
  Vec3 vector(double sigma) { return scale_ * sigma * Vec3{normal_(random_), normal_(random_), normal_(random_)}; }

  double scale_;
  std::mt19937_64 random_{5};
  std::normal_distribution<double> normal_;
};

const Pose place{exp_so3({0.3, -0.8, 0.4}), {10, -30, 450}};

Pose turned_by(double radians) {
  return {exp_so3({0, 0, radians}) * place.rotation, place.translation};
}

double turn(const Pose& a, const Pose& b) {
  return angle_between(a.rotation, b.rotation);
}

TEST(PoseFilter, TheFirstMeasurementIsTheEstimate) {
  PoseFilter filter;
  EXPECT_EQ(filter.estimate().pictures, 0);
  const PoseMeasurement first = Noise().still(place);
  const PoseFilter::Estimate& e = filter.add(first);
  EXPECT_EQ(e.pictures, 1);
  EXPECT_EQ(e.pose.translation, first.pose.translation);
  EXPECT_EQ(e.covariance, first.covariance);
}

TEST(PoseFilter, WhatStandsStillSettlesToTheMean) {
  PoseFilter filter;
  Noise noise;
  double error = 0, step = 0;
  int longest = 0;
  Pose before;
  for (int i = 0; i < 400; ++i) {
    const PoseFilter::Estimate& e = filter.add(noise.still(place));
    if (i >= 100) {
      error = std::max(error, turn(e.pose, place));
      step = std::max(step, turn(e.pose, before));
      longest += e.pictures == PoseFilter::capacity;
    }
    before = e.pose;
  }
  // What varies has a standard deviation of 0.07 of the whole one in the mean of 64, three axes together.
  EXPECT_LT(error, 0.2 * turn_sigma);
  EXPECT_LT(step, 0.1 * turn_sigma);
  EXPECT_EQ(longest, 300);
}

TEST(PoseFilter, AMeanIsNoMoreCertainThanWhatItsMeasurementsHaveInCommon) {
  PoseFilter filter;
  Noise noise;
  for (int i = 0; i < 200; ++i) filter.add(noise.still(place));
  const double share = filter.estimate().covariance(0, 0) / noise.covariance()(0, 0);
  EXPECT_GT(share, 0.85);
  EXPECT_LT(share, 0.95);
}

TEST(PoseFilter, AMotionIsFollowedInItsFirstPicture) {
  PoseFilter filter;
  Noise noise;
  for (int i = 0; i < 100; ++i) filter.add(noise.still(place));
  for (int i = 1; i < 20; ++i) {
    const PoseMeasurement m = noise.moving(turned_by(i * 12 * turn_sigma));
    const PoseFilter::Estimate& e = filter.add(m);
    EXPECT_EQ(e.pictures, 1) << i;
    EXPECT_NEAR(turn(e.pose, m.pose), 0, 1e-12) << i;
  }
}

TEST(PoseFilter, AMotionIsFollowedInAPictureThatIsMeasuredSharply) {
  PoseFilter filter;
  Noise noise, fine(0.2);
  for (int i = 0; i < 60; ++i) {
    const PoseMeasurement sharp = fine.still(place);
    filter.add(noise.still(place), i % 3 == 0 ? &sharp : nullptr);
  }
  const Pose moved = turned_by(12 * turn_sigma);
  const PoseMeasurement sharp = fine.moving(moved);
  const PoseFilter::Estimate& e = filter.add(noise.moving(moved), &sharp);
  EXPECT_EQ(e.pictures, 1);
  EXPECT_NEAR(turn(e.pose, sharp.pose), 0, 1e-12);
}

// However slow the motion is, the estimate is at most half as much again off as the newest measurement alone.
TEST(PoseFilter, AMotionTooSlowToTellIsFollowedWithinTheNoise) {
  for (const double sigmas_a_picture : {0.02, 0.05, 0.1, 0.3, 1.0, 3.0}) {
    PoseFilter filter;
    Noise noise;
    double square = 0;
    constexpr int pictures = 300;
    for (int i = 0; i < pictures; ++i) {
      const Pose truth = turned_by(i * sigmas_a_picture * turn_sigma);
      square += std::pow(turn(filter.add(noise.moving(truth)).pose, truth), 2);
    }
    EXPECT_LT(std::sqrt(square / pictures), 1.5 * std::sqrt(3) * turn_sigma) << sigmas_a_picture;
  }
}

TEST(PoseFilter, SharpMeasurementsOutweighQuickOnes) {
  PoseFilter filter;
  Noise noise, fine(0.1);
  const Pose askew = turned_by(turn_sigma);
  for (int i = 0; i < 64; ++i) {
    const PoseMeasurement sharp = fine.still(place);
    filter.add(noise.still(askew), i % 4 == 0 ? &sharp : nullptr);
  }
  EXPECT_EQ(filter.estimate().pictures, PoseFilter::capacity);
  EXPECT_LT(turn(filter.estimate().pose, place), 0.15 * turn_sigma);
  EXPECT_LT(filter.estimate().covariance(0, 0), fine.covariance()(0, 0));
}

TEST(PoseFilter, WhatIsNotDeterminedIsNotAveraged) {
  PoseFilter filter;
  Noise noise;
  PoseMeasurement m = noise.still(place);
  m.covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  filter.add(noise.still(place));
  EXPECT_EQ(filter.add(m).pose.translation, m.pose.translation);
  const PoseMeasurement good = noise.still(place);
  EXPECT_EQ(filter.add(good).pose.translation, good.pose.translation);
  filter.clear();
  EXPECT_EQ(filter.estimate().pictures, 0);
  filter.add(good);
  EXPECT_EQ(filter.add(good).pictures, 2);
}

TEST(PoseFilter, ACovarianceTurnsWithItsAxes) {
  Matrix6d c = Matrix6d::Zero();
  c.diagonal() << 1, 2, 3, 4, 5, 6;
  c(0, 4) = c(4, 0) = 0.5;
  // x becomes y, y becomes -x.
  const Matrix6d t = turned(c, exp_so3({0, 0, std::acos(0.0)}));
  EXPECT_NEAR(t(0, 0), 2, 1e-12);
  EXPECT_NEAR(t(1, 1), 1, 1e-12);
  EXPECT_NEAR(t(3, 3), 5, 1e-12);
  EXPECT_NEAR(t(1, 3), -0.5, 1e-12);
  EXPECT_NEAR((turned(t, exp_so3({0, 0, -std::acos(0.0)})) - c).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace onestroke::test
