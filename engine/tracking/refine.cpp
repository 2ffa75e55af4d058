#include "tracking/refine.h"

#include "tracking/edges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

struct System {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  std::array<float, max_cells> support{};
  double ring_weight = 0, ring_square = 0, weight = 0, chi2 = 0;
};

double tukey(double residual, double scale) {
  const double u = residual / scale;
  if (std::abs(u) >= 1) return 0;
  const double v = 1 - u * u;
  return v * v;
}

System build(const Intrinsics& k, const EigenPose& pose, const EdgeSet& set, double ring_scale, double outline_scale,
             const RefineOptions& options) {
  System sys;
  for (const EdgeMeasurement& e : set.edges) {
    const double w = tukey(e.offset, e.ring ? ring_scale : outline_scale);
    if (w == 0) continue;
    Vec2d pixel;
    Eigen::Matrix<double, 2, 3> by_point;
    if (!project(k, e.point, pixel, by_point)) continue;
    const Eigen::RowVector3d g = e.normal.transpose() * by_point;
    // p = exp(w) (p - t) + t + v: the derivative by w is -[p - t]x.
    const Vec3d arm = e.point - pose.t;
    Vector6d j;
    j << arm.cross(g.transpose()), g.transpose();
    const double sigma = e.ring ? options.ring_sigma : options.outline_sigma;
    const double iw = w / (sigma * sigma);
    sys.hessian += iw * j * j.transpose();
    sys.gradient += iw * j * e.offset;
    sys.weight += w;
    sys.chi2 += iw * e.offset * e.offset;
    if (e.ring) {
      sys.ring_weight += w;
      sys.support[static_cast<std::size_t>(e.cell)] += static_cast<float>(w);
      sys.ring_square += w * e.offset * e.offset;
    }
  }
  return sys;
}

// 1.4826 times the median of the absolute offsets: the standard deviation, outliers aside.
double spread(const EdgeSet& set, bool ring, std::vector<double>& scratch) {
  scratch.clear();
  for (const EdgeMeasurement& e : set.edges)
    if (e.ring == ring) scratch.push_back(std::abs(e.offset));
  if (scratch.empty()) return 0;
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return 1.4826 * *middle;
}

}  // namespace

Refinement refine(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                  const EigenPose& start, const RefineOptions& options) {
  Refinement result;
  result.pose = start;
  EdgeSet set;
  std::vector<double> scratch;
  System sys;
  for (int i = 0; i < options.max_iterations; ++i) {
    measure_edges(image, intrinsics, rod, inks, result.pose, {options.first_cell, options.last_cell}, set);
    // Wide at first, so that the far arm is drawn in; then as wide as the residuals say.
    const double floor = i < 2 ? 3.0 : (i < 4 ? 1.5 : 0.5);
    const double ring_scale = std::max(floor, 4.7 * spread(set, true, scratch));
    const double outline_scale = std::max(2 * floor, 4.7 * spread(set, false, scratch));
    sys = build(intrinsics, result.pose, set, ring_scale, outline_scale, options);
    if (sys.ring_weight < 6) return result;
    Matrix6d damped = sys.hessian;
    damped.diagonal() += 1e-6 * sys.hessian.diagonal();
    if (options.one_arm) fix_roll(result.pose.R * rod.middle(options.first_cell).tangent, damped);
    Vector6d delta = damped.ldlt().solve(sys.gradient);
    if (!delta.allFinite()) return result;
    // A step of more than a quarter of a radian or 10 % of the distance is a step off the linear model.
    const double turn = delta.head<3>().norm(), shift = delta.tail<3>().norm() / result.pose.t.norm();
    delta *= std::min({1.0, 0.25 / std::max(turn, 1e-12), 0.1 / std::max(shift, 1e-12)});
    result.pose = perturbed(result.pose, delta);
    if (result.pose.t.z() < 10) return result;
    if (i >= 5 && turn < 1e-5 && shift < 1e-6) break;
  }
  const double excess = sys.weight > 6 ? std::max(1.0, sys.chi2 / (sys.weight - 6)) : 1.0;
  result.covariance = covariance_of(sys.hessian / excess);
  result.expected = set.expected_rings;
  result.supported = sys.ring_weight;
  result.support = sys.support;
  result.rms = std::sqrt(sys.ring_square / std::max(sys.ring_weight, 1e-9));
  result.valid = result.covariance.allFinite();
  return result;
}

}  // namespace onestroke
