#include "tracking/camera_model.h"

#include "../core/random_pose.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include <Eigen/Dense>

namespace onestroke::test {
namespace {

Intrinsics plain_camera() {
  return Intrinsics::from_fov(1600, 1200, 35 * std::numbers::pi / 180);
}

Intrinsics distorted_camera() {
  Intrinsics k{900, 910, 633, 371, {-0.21, 0.06, 0.0012, -0.0008, -0.004}};
  return k;
}

TEST(CameraModel, PixelsSurviveTheWayOutAndBack) {
  RandomPose random;
  for (const Intrinsics& k : {plain_camera(), distorted_camera()}) {
    for (int i = 0; i < 500; ++i) {
      const Vec2d pixel(random.uniform(0, 1280), random.uniform(0, 720));
      const Vec2d ray = unproject(k, pixel);
      const double depth = random.uniform(100, 2000);
      Vec2d again;
      ASSERT_TRUE(project(k, depth * Vec3d(ray.x(), ray.y(), 1), again));
      EXPECT_LT((again - pixel).norm(), 1e-5) << pixel.transpose();
    }
  }
}

TEST(CameraModel, ProjectsAsOpenCvDoesHalfAPixelOn) {
  RandomPose random;
  const Intrinsics k = distorted_camera();
  const cv::Matx33d matrix(k.fx, 0, k.cx - 0.5, 0, k.fy, k.cy - 0.5, 0, 0, 1);
  const cv::Mat distortion(1, 5, CV_64F, const_cast<double*>(k.distortion.data()));
  for (int i = 0; i < 100; ++i) {
    const Vec3d p(random.uniform(-300, 300), random.uniform(-150, 150), random.uniform(450, 900));
    std::vector<cv::Point2d> theirs;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(), matrix, distortion,
                      theirs);
    Vec2d ours;
    ASSERT_TRUE(project(k, p, ours));
    EXPECT_NEAR(ours.x(), theirs[0].x + 0.5, 1e-9);
    EXPECT_NEAR(ours.y(), theirs[0].y + 0.5, 1e-9);
  }
}

TEST(CameraModel, TheAxisMeetsTheMiddleOfThePicture) {
  Vec2d pixel;
  ASSERT_TRUE(project(plain_camera(), {0, 0, 500}, pixel));
  EXPECT_DOUBLE_EQ(pixel.x(), 800);
  EXPECT_DOUBLE_EQ(pixel.y(), 600);
  // Half the field of view to the right is the picture's edge, not the centre of its last pixel.
  ASSERT_TRUE(project(plain_camera(), {500 * std::tan(17.5 * std::numbers::pi / 180), 0, 500}, pixel));
  EXPECT_NEAR(pixel.x(), 1600, 1e-9);
}

TEST(CameraModel, NothingBehindTheCameraHasAPixel) {
  Vec2d pixel;
  Eigen::Matrix<double, 2, 3> derivative;
  EXPECT_FALSE(project(plain_camera(), {1, 2, -300}, pixel));
  EXPECT_FALSE(project(plain_camera(), {1, 2, 0}, pixel));
  EXPECT_FALSE(project(plain_camera(), {1, 2, 0}, pixel, derivative));
}

TEST(CameraModel, DerivativeIsThatOfFiniteDifferences) {
  RandomPose random;
  for (const Intrinsics& k : {plain_camera(), distorted_camera()}) {
    for (int i = 0; i < 200; ++i) {
      const Vec3d p(random.uniform(-200, 200), random.uniform(-150, 150), random.uniform(300, 900));
      Vec2d pixel, low = Vec2d::Zero(), high = Vec2d::Zero(), alone;
      Eigen::Matrix<double, 2, 3> derivative;
      ASSERT_TRUE(project(k, p, pixel, derivative));
      ASSERT_TRUE(project(k, p, alone));
      EXPECT_LT((pixel - alone).norm(), 1e-9);
      for (int axis = 0; axis < 3; ++axis) {
        constexpr double h = 1e-3;
        const Vec3d step = h * Vec3d::Unit(axis);
        project(k, p - step, low);
        project(k, p + step, high);
        EXPECT_LT((derivative.col(axis) - (high - low) / (2 * h)).norm(), 1e-6) << "axis " << axis;
      }
    }
  }
}

TEST(CameraModel, PosesSurviveTheWayToEigenAndBack) {
  RandomPose random;
  for (int i = 0; i < 100; ++i) {
    const Pose pose = random.pose();
    const Pose again = from_eigen(to_eigen(pose));
    EXPECT_LT(angle_between(pose.rotation, again.rotation), 1e-7);
    EXPECT_LT(norm(pose.translation - again.translation), 1e-12);
    const Vec3 p = random.vector(100);
    EXPECT_LT((to_eigen(pose) * to_eigen(p) - to_eigen(pose * p)).norm(), 1e-9);
  }
}

TEST(CameraModel, PerturbationTurnsTheMarkerInItsPlace) {
  RandomPose random;
  const Pose pose = random.pose();
  const Vec3 turn = random.turn(0.3), shift = random.vector(5);
  Eigen::Matrix<double, 6, 1> delta;
  delta << to_eigen(turn), to_eigen(shift);
  const Pose moved = from_eigen(perturbed(to_eigen(pose), delta));
  EXPECT_LT(angle_between(moved.rotation, exp_so3(turn) * pose.rotation), 1e-7);
  EXPECT_LT(norm(moved.translation - (pose.translation + shift)), 1e-12);
}

TEST(CameraModel, AFixedRollLeavesOtherTurnsFree) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Vec3d axis = Vec3d(1, 2, -0.5).normalized();
  Matrix6 hessian = Matrix6::Identity();
  // As the points of one arm leave it: nothing is known of the turn about the arm.
  hessian.topLeftCorner<3, 3>() -= axis * axis.transpose();
  Eigen::Matrix<double, 6, 1> gradient;
  gradient << axis + axis.unitOrthogonal(), Vec3d(1, 2, 3);
  fix_roll(axis, hessian);
  const Eigen::Matrix<double, 6, 1> step = hessian.ldlt().solve(gradient);
  EXPECT_LT(std::abs(step.head<3>().dot(axis)), 0.06);
  EXPECT_NEAR(step.head<3>().dot(axis.unitOrthogonal()), 1, 1e-9);
  EXPECT_LT((step.tail<3>() - Vec3d(1, 2, 3)).norm(), 1e-9);
}

}  // namespace
}  // namespace onestroke::test
