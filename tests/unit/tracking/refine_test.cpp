// Poses refined in rendered pictures, and whether their covariance tells the truth.

#include "tracking/refine.h"

#include "view_fixture.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace onestroke::test {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The left perturbation that takes the truth to the pose found.
Vector6 error_of(const Pose& found, const Pose& truth) {
  const Vec3 turn = log_so3(found.rotation * truth.rotation.conjugate());
  const Vec3 shift = found.translation - truth.translation;
  Vector6 e;
  e << to_eigen(turn), to_eigen(shift);
  return e;
}

TEST(Refine, ComesBackFromADisturbedStart) {
  for_disturbed_starts([](const RodModel& rod, const Shot& shot, const Pose& truth, const Pose& start) {
    const Refinement r = refine(shot.view(), shot.intrinsics, rod, inks_at(shot, rod, truth), to_eigen(start));
    ASSERT_TRUE(r.valid);
    EXPECT_LT(turn_between(from_eigen(r.pose), truth), 0.6);
    EXPECT_LT(shift_between(from_eigen(r.pose), truth), 2e-3);
    EXPECT_LT(r.rms, 0.5);
    EXPECT_GT(r.expected, 80);
    EXPECT_GT(r.supported, 0.6 * r.expected);
  });
}

TEST(Refine, CovarianceIsPositiveAndOfTheErrorsOrder) {
  RandomPose random;
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  double normalized_square = 0;
  constexpr int count = 16;
  for (int i = 0; i < count; ++i) {
    const Pose truth = random_view(random);
    const Shot shot = shoot(marker, truth, {.noise = 3, .seed = static_cast<std::uint64_t>(100 + i)});
    const Refinement r = refine(shot.view(), shot.intrinsics, rod, inks_at(shot, rod, truth), to_eigen(truth));
    ASSERT_TRUE(r.valid);
    EXPECT_LT((r.covariance - r.covariance.transpose()).norm(), 1e-9 * r.covariance.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(r.covariance).eigenvalues().minCoeff(), 0);
    const Vector6 e = error_of(from_eigen(r.pose), truth);
    normalized_square += e.dot(r.covariance.ldlt().solve(e)) / 6 / count;
  }
  // 1 where the covariance is exact; within a factor of about three of standard deviation either way.
  EXPECT_GT(normalized_square, 0.1);
  EXPECT_LT(normalized_square, 10);
}

TEST(Refine, FartherMeansLessCertain) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  double last = 0;
  for (const double distance : {300.0, 420.0, 600.0}) {
    const Pose truth = about_middle(exp_so3({0.3, 0.4, 0}), {0, 0, distance});
    const Shot shot = shoot(marker, truth);
    const Refinement r = refine(shot.view(), shot.intrinsics, rod, inks_at(shot, rod, truth), to_eigen(truth));
    ASSERT_TRUE(r.valid);
    const double depth_sigma = std::sqrt(r.covariance(5, 5));
    EXPECT_GT(depth_sigma, last);
    last = depth_sigma;
  }
}

TEST(Refine, OneArmKeepsItsRoll) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose truth = about_middle(exp_so3({0.3, 0.2, 0.5}), {0, 0, 330});
  const Shot shot = shoot(marker, truth);
  const Pose rolled = truth * Pose{exp_so3({0, 0.7, 0}), {}};
  RefineOptions options;
  options.one_arm = true;
  options.last_cell = 17;
  const Refinement r = refine(shot.view(), shot.intrinsics, rod, inks_at(shot, rod, truth), to_eigen(rolled), options);
  ASSERT_TRUE(r.valid);
  EXPECT_NEAR(turn_between(from_eigen(r.pose), truth), 0.7 / radian, 2);
  EXPECT_GT((r.pose.R * Vec3d(0, 1, 0)).dot(to_eigen(truth).R * Vec3d(0, 1, 0)), std::cos(0.5 * radian));
}

TEST(Refine, APictureWithoutTheRodIsNotValid) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose pose = about_middle({}, {0, 0, 350});
  const Shot with = shoot(marker, pose), without = shoot(std::vector<Placed>{});
  EXPECT_FALSE(refine(without.view(), without.intrinsics, rod, inks_at(with, rod, pose), to_eigen(pose)).valid);
}

TEST(Refine, AStartOutsideThePictureIsNotValid) {
  const MarkerSpec marker = angle_marker(2);
  const RodModel rod(marker);
  const Pose pose = about_middle({}, {0, 0, 350});
  const Shot shot = shoot(marker, pose);
  const Inks inks = inks_at(shot, rod, pose);
  for (const Vec3 away : {Vec3{3000, 0, 350}, Vec3{0, 0, -350}, Vec3{0, 0, 0}})
    EXPECT_FALSE(refine(shot.view(), shot.intrinsics, rod, inks, to_eigen(about_middle({}, away))).valid);
}

}  // namespace
}  // namespace onestroke::test
