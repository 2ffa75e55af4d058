// Two measurements of one pose as one.

#include "tracking/pose_fusion.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace onestroke::test {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Any covariance: sigmas of up to turn_sigma, rad, and shift_sigma, mm, along any axes, with all in common.
class Draws {
 public:
  Matrix6d covariance(double turn_sigma, double shift_sigma) {
    Matrix6d mix;
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) mix(r, c) = normal_(random_);
    Vector6d scale;
    scale << Vec3d::Constant(turn_sigma), Vec3d::Constant(shift_sigma);
    const Matrix6d shape = mix * mix.transpose() / 6 + 0.01 * Matrix6d::Identity();
    return scale.asDiagonal() * shape * scale.asDiagonal();
  }
  Pose pose() {
    const Vec3 w{normal_(random_), normal_(random_), normal_(random_)};
    return {exp_so3(w), {30 * normal_(random_), 30 * normal_(random_), 450 + 50 * normal_(random_)}};
  }
  /// What a sensor of that covariance says of the truth.
  PoseMeasurement measured(const Pose& truth, const Matrix6d& covariance) {
    Vector6d unit;
    for (int i = 0; i < 6; ++i) unit[i] = normal_(random_);
    const Vector6d error = covariance.llt().matrixL() * unit;
    return {from_eigen(perturbed(to_eigen(truth), error)), covariance};
  }

 private:
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

double smallest_eigenvalue(const Matrix6d& m) {
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(m).eigenvalues().minCoeff();
}

// Of turns and shifts in one unit, so that neither outweighs the other.
Matrix6d in_sigmas(const Matrix6d& covariance) {
  Vector6d scale;
  scale << Vec3d::Constant(1 / 0.01), Vec3d::Constant(1.0);
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

TEST(PoseFusion, IsTheWeightedMeanWhereAxesAreIndependent) {
  // The textbook's: m = (m1 / s1^2 + m2 / s2^2) / (1 / s1^2 + 1 / s2^2), the variance 1 over that sum.
  Vector6d variance_a, variance_b;
  variance_a << 1e-4, 4e-4, 9e-4, 1, 4, 0.25;
  variance_b << 4e-4, 1e-4, 9e-4, 9, 1, 0.25;
  const PoseMeasurement a{{exp_so3({0.02, 0, 0}), {1, 2, 3}}, variance_a.asDiagonal()};
  const PoseMeasurement b{{exp_so3({0.03, 0, 0}), {3, 1, 5}}, variance_b.asDiagonal()};
  const PoseMeasurement both = fused(a, b);
  EXPECT_NEAR(log_so3(both.pose.rotation).x, 0.02 + 0.01 * 1e-4 / 5e-4, 1e-12);
  EXPECT_NEAR(both.pose.translation.x, 1 + 2 * 1.0 / 10, 1e-12);
  EXPECT_NEAR(both.pose.translation.y, 2 - 1 * 4.0 / 5, 1e-12);
  EXPECT_NEAR(both.pose.translation.z, 4, 1e-12);
  for (int i = 0; i < 6; ++i) {
    // About the other axes the two rotations' errors are turned a little towards each other.
    const double textbook = 1 / (1 / variance_a[i] + 1 / variance_b[i]);
    EXPECT_NEAR(both.covariance(i, i) / textbook, 1, i == 1 || i == 2 ? 1e-4 : 1e-9) << i;
  }
}

TEST(PoseFusion, DoesNotMindTheOrder) {
  Draws draws;
  for (int i = 0; i < 100; ++i) {
    const Pose truth = draws.pose();
    const auto a = draws.measured(truth, draws.covariance(0.1, 3)), b = draws.measured(truth, draws.covariance(0.1, 3));
    const PoseMeasurement ab = fused(a, b), ba = fused(b, a);
    EXPECT_LT(angle_between(ab.pose.rotation, ba.pose.rotation), 1e-7);
    EXPECT_LT(norm(ab.pose.translation - ba.pose.translation), 1e-9);
    EXPECT_LT((ab.covariance - ba.covariance).norm(), 1e-9 * ab.covariance.norm());
    EXPECT_NEAR(disagreement(a, b), disagreement(b, a), 1e-6 * disagreement(a, b));
  }
}

TEST(PoseFusion, IsNoLessSureThanEither) {
  Draws draws;
  for (int i = 0; i < 200; ++i) {
    const Pose truth = draws.pose();
    const PoseMeasurement a{truth, draws.covariance(0.02, 2)}, b{truth, draws.covariance(0.02, 2)};
    const PoseMeasurement both = fused(a, b);
    for (const PoseMeasurement& one : {a, b})
      EXPECT_GT(smallest_eigenvalue(in_sigmas(one.covariance - both.covariance)), -1e-12);
    EXPECT_GT(smallest_eigenvalue(in_sigmas(both.covariance)), 0);
  }
}

TEST(PoseFusion, StaysWhereBothAgree) {
  Draws draws;
  const Pose truth = draws.pose();
  const PoseMeasurement a{truth, draws.covariance(0.02, 2)}, b{truth, draws.covariance(0.3, 30)};
  EXPECT_LT(angle_between(fused(a, b).pose.rotation, truth.rotation), 1e-7);
  EXPECT_LT(norm(fused(a, b).pose.translation - truth.translation), 1e-9);
  EXPECT_LT(disagreement(a, b), 1e-9);
}

// The normalised error squared of a fusion that is what it says has a mean of 6, and so has the disagreement.
TEST(PoseFusion, ErrsByAsMuchAsItSays) {
  Draws draws;
  constexpr int many = 4000;
  double nees = 0, apart = 0;
  for (int i = 0; i < many; ++i) {
    const Pose truth = draws.pose();
    const auto a = draws.measured(truth, draws.covariance(0.02, 2)),
               b = draws.measured(truth, draws.covariance(0.02, 2));
    const PoseMeasurement both = fused(a, b);
    const Vector6d error = perturbation(to_eigen(both.pose), to_eigen(truth));
    nees += error.dot(both.covariance.ldlt().solve(error)) / many;
    apart += disagreement(a, b) / many;
  }
  // Chi squared with 6 degrees of freedom has a variance of 12: a mean of so many is within 4 sigmas of 6.
  const double four_sigmas = 4 * std::sqrt(12.0 / many);
  EXPECT_NEAR(nees, 6, four_sigmas);
  EXPECT_NEAR(apart, 6, four_sigmas);
}

TEST(PoseFusion, LetsTheOtherTellWhatOneDoesNot) {
  // One knows nothing of the roll about x, a radian or so; the other all.
  Matrix6d vague = Matrix6d::Identity() * 1e-6, sure = Matrix6d::Identity() * 1e-6;
  vague.bottomRightCorner<3, 3>() *= 1e5;
  sure.bottomRightCorner<3, 3>() *= 1e5;
  vague(0, 0) = 1;
  const PoseMeasurement a{{exp_so3({0.8, 0, 0}), {0, 0, 400}}, vague}, b{{{}, {0, 0, 400.2}}, sure};
  const PoseMeasurement both = fused(a, b);
  EXPECT_LT(angle_between(both.pose.rotation, b.pose.rotation), 1e-5);
  EXPECT_NEAR(both.pose.translation.z, 400.1, 1e-6);
}

}  // namespace
}  // namespace onestroke::test
