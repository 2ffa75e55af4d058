#include "tracking/camera_model.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace onestroke {

EigenPose to_eigen(const Pose& p) {
  const Mat3 m = to_matrix(p.rotation);
  EigenPose e;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) e.R(r, c) = m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  e.t = to_eigen(p.translation);
  return e;
}

Pose from_eigen(const EigenPose& p) {
  Mat3 m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = p.R(r, c);
  return {to_quat(m), {p.t.x(), p.t.y(), p.t.z()}};
}

double angle_between(const EigenPose& a, const EigenPose& b) {
  return std::acos(std::clamp(((a.R * b.R.transpose()).trace() - 1) / 2, -1.0, 1.0));
}

double relative_distance(const EigenPose& a, const EigenPose& b) {
  return (a.t - b.t).norm() / a.t.norm();
}

EigenPose perturbed(const EigenPose& p, const Eigen::Matrix<double, 6, 1>& delta) {
  const Mat3 m = to_matrix(exp_so3({delta[0], delta[1], delta[2]}));
  Mat3d w;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) w(r, c) = m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  return {w * p.R, p.t + delta.tail<3>()};
}

Eigen::Matrix<double, 6, 1> perturbation(const EigenPose& from, const EigenPose& to) {
  const Vec3 w = log_so3(from_eigen(to).rotation * from_eigen(from).rotation.conjugate());
  Eigen::Matrix<double, 6, 1> delta;
  delta << w.x, w.y, w.z, to.t - from.t;
  return delta;
}

void fix_roll(const Vec3d& axis, Eigen::Matrix<double, 6, 6>& hessian) {
  hessian.topLeftCorner<3, 3>() += 10 * hessian.topLeftCorner<3, 3>().trace() * axis * axis.transpose();
}

Eigen::Matrix<double, 6, 6> covariance_of(const Eigen::Matrix<double, 6, 6>& information) {
  // Scaled to units of the prior, so that rounding leaves the inverse positive definite.
  Eigen::Matrix<double, 6, 1> unit;
  unit << 1, 1, 1, 1000, 1000, 1000;
  Eigen::Matrix<double, 6, 6> whole = unit.asDiagonal() * information * unit.asDiagonal();
  whole.diagonal().array() += 1;
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factors(whole);
  // A pivot below the prior is rounding's.
  if (factors.info() == Eigen::Success && factors.matrixLLT().diagonal().minCoeff() >= 1)
    return unit.asDiagonal() * factors.solve(Eigen::Matrix<double, 6, 6>(unit.asDiagonal()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> parts(whole);
  const Eigen::Matrix<double, 6, 1> variances = parts.eigenvalues().cwiseMax(1).cwiseInverse();
  const Eigen::Matrix<double, 6, 6> v = unit.asDiagonal() * parts.eigenvectors();
  return v * variances.asDiagonal() * v.transpose();
}

namespace {

// OpenCV's radial (k1 k2 k3) and tangential (p1 p2) model, with its 2 x 2 derivative.
Vec2d distort(const std::array<double, 5>& d, const Vec2d& n, Eigen::Matrix2d* jacobian) {
  const double x = n.x(), y = n.y(), r2 = x * x + y * y;
  const double k1 = d[0], k2 = d[1], p1 = d[2], p2 = d[3], k3 = d[4];
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (jacobian) {
    const double dr = k1 + r2 * (2 * k2 + r2 * 3 * k3);
    (*jacobian)(0, 0) = radial + 2 * x * x * dr + 2 * p1 * y + 6 * p2 * x;
    (*jacobian)(0, 1) = 2 * x * y * dr + 2 * p1 * x + 2 * p2 * y;
    (*jacobian)(1, 0) = 2 * x * y * dr + 2 * p1 * x + 2 * p2 * y;
    (*jacobian)(1, 1) = radial + 2 * y * y * dr + 6 * p1 * y + 2 * p2 * x;
  }
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

}  // namespace

Vec2d distorted(const Intrinsics& k, const Vec2d& n) {
  return distort(k.distortion, n, nullptr);
}

bool project(const Intrinsics& k, const Vec3d& p, Vec2d& pixel, Eigen::Matrix<double, 2, 3>& d_pixel_d_point) {
  if (p.z() < 1.0) return false;
  const double iz = 1 / p.z();
  Vec2d n(p.x() * iz, p.y() * iz);
  d_pixel_d_point << iz, 0, -n.x() * iz, 0, iz, -n.y() * iz;
  if (k.distorted()) {
    Eigen::Matrix2d jacobian;
    n = distort(k.distortion, n, &jacobian);
    d_pixel_d_point = jacobian * d_pixel_d_point;
  }
  d_pixel_d_point.row(0) *= k.fx;
  d_pixel_d_point.row(1) *= k.fy;
  pixel = {k.fx * n.x() + k.cx, k.fy * n.y() + k.cy};
  return true;
}

Vec2d unproject(const Intrinsics& k, const Vec2d& pixel) {
  Vec2d target((pixel.x() - k.cx) / k.fx, (pixel.y() - k.cy) / k.fy);
  if (!k.distorted()) return target;
  Vec2d n = target;
  for (int i = 0; i < 10; ++i) {
    Eigen::Matrix2d jacobian;
    const Vec2d error = distort(k.distortion, n, &jacobian) - target;
    if (error.squaredNorm() < 1e-18) break;
    n -= jacobian.inverse() * error;
  }
  return n;
}

}  // namespace onestroke
