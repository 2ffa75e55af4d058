#pragma once

#include "core/picture.h"

#include <Eigen/Core>

namespace onestroke {

using Vec2d = Eigen::Vector2d;
using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// T_camera_marker as the solvers hold it.
struct EigenPose {
  Mat3d R = Mat3d::Identity();
  Vec3d t = Vec3d::Zero();

  Vec3d operator*(const Vec3d& p) const { return R * p + t; }
};

EigenPose to_eigen(const Pose& p);
Pose from_eigen(const EigenPose& p);
inline Vec3d to_eigen(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// The angle between two poses, radians.
double angle_between(const EigenPose& a, const EigenPose& b);
/// How far apart they lie, as a share of the distance from the camera.
double relative_distance(const EigenPose& a, const EigenPose& b);

/// p moved by the left perturbation (rotation vector rad, translation mm): R = exp(w) R, t = exp(w) t + v would swing
/// the translation about the camera; here R = exp(w) R and t = t + v, so the covariance reads in the marker's own
/// place.
EigenPose perturbed(const EigenPose& p, const Eigen::Matrix<double, 6, 1>& delta);

/// The delta by which perturbed() makes `to` of `from`.
Eigen::Matrix<double, 6, 1> perturbation(const EigenPose& from, const EigenPose& to);

/// Keeps a least-squares step from turning about an axis (camera axes): the points of one straight arm say nothing of
/// it.
void fix_roll(const Vec3d& axis, Eigen::Matrix<double, 6, 6>& hessian);

/// The covariance of a pose that least squares found, from its information (inverse covariance) in the order of
/// perturbed(). What the picture does not tell stays as uncertain as a turn of a radian and a shift of a metre.
Eigen::Matrix<double, 6, 6> covariance_of(const Eigen::Matrix<double, 6, 6>& information);

/// The image of a point at the depth 1, after the lens has distorted it.
Vec2d distorted(const Intrinsics& k, const Vec2d& n);

/// Pixel (centres at half-integers) of a point in camera axes; false behind the camera.
inline bool project(const Intrinsics& k, const Vec3d& p, Vec2d& pixel) {
  if (p.z() < 1.0) return false;
  const double iz = 1 / p.z();
  Vec2d n(p.x() * iz, p.y() * iz);
  if (k.distorted()) n = distorted(k, n);
  pixel = {k.fx * n.x() + k.cx, k.fy * n.y() + k.cy};
  return true;
}

/// As project, with the 2 x 3 derivative of the pixel by the point.
bool project(const Intrinsics& k, const Vec3d& p, Vec2d& pixel, Eigen::Matrix<double, 2, 3>& d_pixel_d_point);

/// Undistorted ray (x/z, y/z) of a pixel.
Vec2d unproject(const Intrinsics& k, const Vec2d& pixel);

}  // namespace onestroke
