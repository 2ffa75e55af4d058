#include "tracking/initial_pose.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

// Gravity centre of the half ring that faces the eye: 2/pi of the radius would be its mean over the angle, pi/4 is its
// mean over the projected width.
Vec3d seen_centre(const RodModel& rod, int cell, const Vec3d& eye) {
  const RodModel::Section& m = rod.middle(cell);
  const Vec3d view = eye - m.centre, front = view - m.tangent * view.dot(m.tangent);
  // Where the eye looks down the axis no side faces it.
  return m.centre + 0.785 * rod.radius() / std::max(front.norm(), 1e-9) * front;
}

}  // namespace

bool fit_cells(const Intrinsics& k, const RodModel& rod, std::span<const CellPoint> points, bool one_arm,
               PoseGuess& guess) {
  using Vector6d = Eigen::Matrix<double, 6, 1>;

  for (int i = 0; i < 10; ++i) {
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    double square = 0;
    const Vec3d eye = -guess.pose.R.transpose() * guess.pose.t;
    for (const CellPoint& p : points) {
      const Vec3d x = guess.pose * seen_centre(rod, p.cell, eye);
      Vec2d pixel;
      Eigen::Matrix<double, 2, 3> by_point;
      if (!project(k, x, pixel, by_point)) return false;
      const Vec2d error = p.pixel - pixel;
      // Huber's weight at 3 pixels: a merged cell must not bend the pose.
      const double w = 1 / std::max(1.0, error.norm() / 3);
      const Vec3d arm = x - guess.pose.t;
      for (int row = 0; row < 2; ++row) {
        const Vec3d g = by_point.row(row).transpose();
        Vector6d j;
        j.head<3>() = arm.cross(g);
        j.tail<3>() = g;
        const Vector6d weighted = w * j;
        for (int c = 0; c < 6; ++c) hessian.col(c) += j[c] * weighted;
        gradient += weighted * error[row];
      }
      square += error.squaredNorm();
    }
    guess.rms = std::sqrt(square / static_cast<double>(points.size()));
    hessian.diagonal() *= 1 + 1e-6;
    if (one_arm) fix_roll(guess.pose.R * rod.middle(points.front().cell).tangent, hessian);
    Vector6d delta = hessian.ldlt().solve(gradient);
    if (!delta.allFinite()) return false;
    const double turn = delta.head<3>().norm(), shift = delta.tail<3>().norm() / guess.pose.t.norm();
    delta *= std::min({1.0, 0.3 / std::max(turn, 1e-12), 0.2 / std::max(shift, 1e-12)});
    guess.pose = perturbed(guess.pose, delta);
    if (guess.pose.t.z() < 10) return false;
    if (turn < 1e-4 && shift < 1e-4) break;
  }
  return true;
}

std::vector<PoseGuess> poses_from_row(const Intrinsics& k, const RodModel& rod, const std::vector<CellPoint>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const CellPoint& a, const CellPoint& b) { return a.cell < b.cell; });
  const Vec3d a = rod.middle(low->cell).centre, b = rod.middle(high->cell).centre;
  const Vec2d across = high->pixel - low->pixel, middle = (low->pixel + high->pixel) / 2;
  const Vec3d axis = (b - a).normalized();
  const Vec2d ray = unproject(k, middle);
  std::vector<PoseGuess> guesses;
  for (const double tilt : {-0.96, -0.35, 0.35, 0.96}) {
    const Vec2d d = across.normalized();
    const Vec3d direction(std::cos(tilt) * d.x(), std::cos(tilt) * d.y(), std::sin(tilt));
    const double depth = k.fx * std::cos(tilt) * (b - a).norm() / std::max(across.norm(), 1e-6);
    PoseGuess g;
    g.pose.R = Eigen::Quaterniond::FromTwoVectors(axis, direction).toRotationMatrix();
    g.pose.t = depth * Vec3d(ray.x(), ray.y(), 1) - g.pose.R * ((a + b) / 2);
    if (!fit_cells(k, rod, points, true, g)) continue;
    const bool known = std::any_of(guesses.begin(), guesses.end(),
                                   [&](const PoseGuess& o) { return (o.pose.R * axis).dot(g.pose.R * axis) > 0.998; });
    if (!known) guesses.push_back(g);
  }
  std::sort(guesses.begin(), guesses.end(), [](const PoseGuess& x, const PoseGuess& y) { return x.rms < y.rms; });
  return guesses;
}

std::vector<PoseGuess> poses_from_cells(const Intrinsics& k, const RodModel& rod,
                                        const std::vector<CellPoint>& points) {
  std::vector<PoseGuess> guesses;
  if (points.size() < 4) return guesses;
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> seen;
  for (const CellPoint& p : points) {
    const Vec3d c = rod.middle(p.cell).centre;
    const Vec2d n = unproject(k, p.pixel);
    object.emplace_back(c.x(), c.y(), c.z());
    seen.emplace_back(n.x(), n.y());
  }
  std::vector<cv::Mat> rvecs, tvecs;
  try {
    cv::solvePnPGeneric(object, seen, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rvecs, tvecs, false,
                        cv::SOLVEPNP_IPPE);
  } catch (const cv::Exception&) {
    return guesses;
  }
  for (std::size_t i = 0; i < rvecs.size(); ++i) {
    cv::Mat rotation;
    cv::Rodrigues(rvecs[i], rotation);
    PoseGuess g;
    cv::cv2eigen(rotation, g.pose.R);
    cv::cv2eigen(tvecs[i], g.pose.t);
    if (!g.pose.R.allFinite() || !g.pose.t.allFinite() || g.pose.t.z() < 10) continue;
    if (fit_cells(k, rod, points, false, g)) guesses.push_back(g);
  }
  std::sort(guesses.begin(), guesses.end(), [](const PoseGuess& a, const PoseGuess& b) { return a.rms < b.rms; });
  return guesses;
}

InlineVector<PoseGuess, 2> poses_in_weak_perspective(const Intrinsics& k, const RodModel& rod,
                                                     std::span<const CellPoint> points) {
  InlineVector<PoseGuess, 2> guesses;
  if (points.size() < 4) return guesses;
  const auto n = static_cast<double>(points.size());
  Vec3d mean = Vec3d::Zero();
  Vec2d ray = Vec2d::Zero();
  for (const CellPoint& p : points) {
    mean += rod.middle(p.cell).centre / n;
    ray += unproject(k, p.pixel) / n;
  }
  // Axes in which the rod's plane lies square to the third, and the mean ray is the line of sight.
  Mat3d plane;
  plane.col(2) = rod.plane_normal();
  plane.col(0) = plane.col(2).unitOrthogonal();
  plane.col(1) = plane.col(2).cross(plane.col(0));
  const Mat3d sight = Eigen::Quaterniond::FromTwoVectors(Vec3d(ray.x(), ray.y(), 1), Vec3d::UnitZ()).toRotationMatrix();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), seen = spread;
  Vec2d middle = Vec2d::Zero();
  for (const CellPoint& p : points) {
    const Vec2d on = (plane.transpose() * (rod.middle(p.cell).centre - mean)).head<2>(), u = unproject(k, p.pixel);
    const Vec3d q = sight * Vec3d(u.x(), u.y(), 1);
    const Vec2d at = q.head<2>() / q.z();
    middle += at / n;
    spread += on * on.transpose();
    seen += at * on.transpose();
  }
  // Points on one line leave the other direction open.
  if (spread.determinant() < 1e-4 * spread.trace() * spread.trace()) return guesses;
  const Eigen::Matrix2d map = seen * spread.inverse();
  const double aa = map.col(0).squaredNorm(), bb = map.col(1).squaredNorm(), ab = map.col(0).dot(map.col(1));
  const double scale = std::sqrt((aa + bb + std::sqrt((aa - bb) * (aa - bb) + 4 * ab * ab)) / 2);
  if (!(scale > 1e-9)) return guesses;
  const double za = std::sqrt(std::max(0.0, 1 - aa / (scale * scale)));
  const double zb = std::copysign(std::sqrt(std::max(0.0, 1 - bb / (scale * scale))), -ab);
  for (const double sign : {1.0, -1.0}) {
    Mat3d turned;
    turned.col(0) = Vec3d(map(0, 0) / scale, map(1, 0) / scale, sign * za).normalized();
    const Vec3d b(map(0, 1) / scale, map(1, 1) / scale, sign * zb);
    turned.col(2) = turned.col(0).cross(b).normalized();
    turned.col(1) = turned.col(2).cross(turned.col(0));
    PoseGuess g;
    g.pose.R = sight.transpose() * turned * plane.transpose();
    g.pose.t = sight.transpose() * Vec3d(middle.x(), middle.y(), 1) / scale - g.pose.R * mean;
    if (g.pose.t.allFinite() && fit_cells(k, rod, points, false, g)) guesses.push_back(g);
  }
  if (guesses.size() == 2 && guesses[1].rms < guesses[0].rms) std::swap(guesses[0], guesses[1]);
  return guesses;
}

}  // namespace onestroke
