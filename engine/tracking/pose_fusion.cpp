#include "tracking/pose_fusion.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

// The inverse of the right Jacobian of SO(3): by how much log(E exp(-w)) is less than log(E) = e, for each part of w.
Mat3d inverse_right_jacobian(const Vec3d& e) {
  Mat3d cross;
  cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
  const double angle = e.norm();
  // By its series near zero, where the quotients lose digits.
  const double k =
      angle < 1e-3 ? 1.0 / 12 : 1 / (angle * angle) - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return Mat3d::Identity() + 0.5 * cross + k * cross * cross;
}

Matrix6d jacobian(const Vector6d& error) {
  Matrix6d j = Matrix6d::Identity();
  j.topLeftCorner<3, 3>() = inverse_right_jacobian(error.head<3>());
  return j;
}

}  // namespace

double disagreement(const PoseMeasurement& a, const PoseMeasurement& b) {
  const Vector6d apart = perturbation(to_eigen(a.pose), to_eigen(b.pose));
  return apart.dot((a.covariance + b.covariance).ldlt().solve(apart));
}

PoseMeasurement fused(const PoseMeasurement& a, const PoseMeasurement& b) {
  const std::array poses{to_eigen(a.pose), to_eigen(b.pose)};
  const std::array<Matrix6d, 2> informations{a.covariance.inverse(), b.covariance.inverse()};
  EigenPose pose = to_eigen(interpolate(a.pose, b.pose, 0.5));
  Matrix6d together = Matrix6d::Zero();
  // Measurements that agree are there after the second.
  constexpr int most_steps = 6;
  constexpr double small_step = 1e-12;
  for (int i = 0; i < most_steps; ++i) {
    together.setZero();
    Vector6d pull = Vector6d::Zero();
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const Vector6d error = perturbation(pose, poses[k]);
      const Matrix6d j = jacobian(error);
      together += j.transpose() * informations[k] * j;
      pull += j.transpose() * informations[k] * error;
    }
    const Vector6d step = together.ldlt().solve(pull);
    pose = perturbed(pose, step);
    if (step.squaredNorm() < small_step * small_step) break;
  }
  return {from_eigen(pose), together.inverse(), a.as_expected || b.as_expected};
}

}  // namespace onestroke
