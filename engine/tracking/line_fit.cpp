#include "tracking/line_fit.h"

#include "tracking/line_solver.h"

#include <Eigen/Dense>
#include <algorithm>

namespace onestroke {
namespace {

// Asks for the pixels of the rod ahead of all passes, which otherwise come from memory one by one.
void fetch(const TimedView& view, const RodModel& rod, const EigenPose& pose) {
  const ImageView& image = view.image;
  constexpr int margin = 4;
  for (int e = 0; e <= rod.cell_count(); ++e) {
    const Vec3d centre = pose * rod.edge(e).centre;
    Vec2d p;
    if (!project(view.intrinsics, centre, p) || !image.contains(p.x(), p.y())) continue;
    const int half = static_cast<int>(view.intrinsics.fx * rod.radius() / centre.z()) + margin;
    const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y());
    for (int v = std::max(0, y - half); v < std::min(image.height, y + half); ++v)
      for (const int u : {std::max(0, x - half), x, std::min(image.width - 1, x + half)})
        __builtin_prefetch(image.at(u, v));
  }
}

}  // namespace

void take_velocity(const TimedView& view, const LineFit& fit, Detection& d) {
  if (!view.clock.rolls()) return;
  d.moving = true;
  d.angular = fit.motion.angular;
  d.linear = fit.motion.linear;
  d.velocity_covariance = fit.covariance.bottomRightCorner<6, 6>();
}

void MotionPrior::add(const EigenPose& told, const Matrix6d& covariance) {
  const Matrix6d information = covariance.inverse();
  pose_information += information;
  pose = pose ? perturbed(*pose, pose_information.ldlt().solve(information * perturbation(*pose, told))) : told;
}

LineFit LineFitter::fit(const TimedView& view, const RodModel& rod, const Inks& inks, const Motion& start,
                        const MotionPrior& prior, std::span<const LineOptions> passes) {
  LineFit fit;
  fit.motion = start;
  Matrix12d information = Matrix12d::Zero();
  information.topLeftCorner<6, 6>() = prior.pose_information;
  information.diagonal().segment<3>(6).setConstant(1 / (prior.angular * prior.angular));
  information.diagonal().tail<3>().setConstant(1 / (prior.linear * prior.linear));
  const auto pass = [&]<int N>(std::integral_constant<int, N>, const LineOptions& options) {
    line_solver::Vector12d mean;
    mean.head<6>() = perturbation(fit.motion.pose, prior.pose.value_or(start.pose));
    mean.segment<3>(6) = start.angular - fit.motion.angular;
    mean.tail<3>() = start.linear - fit.motion.linear;
    line_solver::LineSolver<N> solver(set_, mean, information, memory_);
    if (!solver.solve(options.reweightings)) return false;
    const auto& d = solver.delta();
    // A step of more than a quarter of a radian or 10 % of the distance is a step off the linear model.
    if (d.template head<3>().norm() > 0.25 || d.template segment<3>(3).norm() > 0.1 * fit.motion.pose.t.norm())
      return false;
    fit.motion.pose = perturbed(fit.motion.pose, d.template head<6>());
    if constexpr (N == 12) {
      fit.motion.angular += d.template segment<3>(6);
      fit.motion.linear += d.template segment<3>(9);
    }
    if (&options == &passes.back()) {
      fit.covariance.topLeftCorner<N, N>() = solver.covariance();
      fit.moved = solver.moved();
    }
    fit.support = solver.support();
    fit.supported = solver.ring_weight();
    fit.rms = solver.rms();
    return fit.motion.pose.t.z() > 10 && fit.covariance.allFinite();
  };
  fetch(view, rod, start.pose);
  const auto run = [&](const LineOptions& options) {
    measure_lines(view, rod, inks, fit.motion, options, set_);
    fit.expected = set_.expected;
    fit.shown = set_.shown;
    return view.clock.rolls() ? pass(std::integral_constant<int, 12>{}, options)
                              : pass(std::integral_constant<int, 6>{}, options);
  };
  for (const LineOptions& options : passes)
    if (!run(options)) return fit;
  for (std::size_t c = 0; c < fit.support.size(); ++c) {
    if (set_.expected_at[c] == 0) continue;
    ++fit.edges;
    fit.support[c] /= static_cast<float>(set_.expected_at[c]);
  }
  fit.valid = true;
  return fit;
}

}  // namespace onestroke
