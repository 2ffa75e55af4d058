#include "tracking/hand_eye.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

// A step, in deviations, that changes nothing.
constexpr double settled = 1e-4;
// As much of a variance.
constexpr double unchanged = 3e-3;
// What is never known better: 1e-6 rad and 1e-4 mm.
constexpr std::array<double, HandEyeNoise::parts> least_variance{1e-12, 1e-8, 1e-12, 1e-8};

struct Normal {
  Matrix12d information = Matrix12d::Zero();
  Vector12d gradient = Vector12d::Zero();
  double cost = 0;
};

Normal normal_equations(const HandEyeFit& fit, const std::vector<EigenSight>& sights) {
  Normal n;
  for (const EigenSight& sight : sights) {
    const Matrix6d weight = hand_eye_covariance(fit.found, sight, fit.noise).inverse();
    const Vector6d r = hand_eye_residual(fit.found, sight);
    const auto J = hand_eye_jacobian(fit.found, sight);
    n.information += J.transpose() * weight * J;
    n.gradient += J.transpose() * weight * r;
    n.cost += r.dot(weight * r);
  }
  return n;
}

HandEye moved(const HandEye& from, const Vector12d& step) {
  return {.T_head_camera = perturbed(from.T_head_camera, step.head<6>()),
          .T_world_marker = perturbed(from.T_world_marker, step.tail<6>())};
}

/// One step of Gauss and Newton, shortened until it helps; how long it was, in deviations.
double step_poses(HandEyeFit& fit, const std::vector<EigenSight>& sights) {
  const Normal n = normal_equations(fit, sights);
  Vector12d step = -n.information.ldlt().solve(n.gradient);
  for (int halved = 0; halved < 10; ++halved, step /= 2) {
    HandEyeFit tried = fit;
    tried.found = moved(fit.found, step);
    double cost = 0;
    for (const EigenSight& sight : sights) {
      const Vector6d r = hand_eye_residual(tried.found, sight);
      cost += r.dot(hand_eye_covariance(fit.found, sight, fit.noise).ldlt().solve(r));
    }
    if (!(cost <= n.cost)) continue;
    fit.found = tried.found;
    return std::sqrt(step.dot(n.information * step));
  }
  return 0;
}

/// One step of the MM algorithm for variance components, which never leads to a worse likelihood nor below zero; the
/// greatest relative change.
double step_noise(HandEyeFit& fit, const std::vector<EigenSight>& sights) {
  std::array<double, HandEyeNoise::parts> told{}, expected{};
  for (const EigenSight& sight : sights) {
    const Matrix6d weight = hand_eye_covariance(fit.found, sight, fit.noise).inverse();
    const Vector6d weighted = weight * hand_eye_residual(fit.found, sight);
    const auto shapes = hand_eye_noise_shapes(fit.found, sight);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      told[k] += weighted.dot(shapes[k] * weighted);
      expected[k] += (weight * shapes[k]).trace();
    }
  }
  // Twelve of the residuals' dimensions went into the poses.
  const double all = 6 * static_cast<double>(sights.size()), freed = all / std::max(1.0, all - 12);
  double change = 0;
  for (std::size_t k = 0; k < told.size(); ++k) {
    if (!fit.noise.estimated[k]) continue;
    const double factor = std::sqrt(freed * told[k] / expected[k]), before = fit.noise.variance[k];
    fit.noise.variance[k] = std::max(before * factor, least_variance[k]);
    change = std::max(change, std::abs(fit.noise.variance[k] - before) / before);
  }
  return change;
}

}  // namespace

HandEyeFit fit_hand_eye(const HandEyeFit& guess, const std::vector<EigenSight>& sights, int most_rounds) {
  HandEyeFit fit = guess;
  for (std::size_t k = 0; k < HandEyeNoise::parts; ++k)
    if (fit.noise.estimated[k]) fit.noise.variance[k] = std::max(fit.noise.variance[k], least_variance[k]);
  for (int round = 0; round < most_rounds; ++round) {
    const double step = step_poses(fit, sights);
    const double change = step_noise(fit, sights);
    if (step < settled && change < unchanged) break;
  }
  fit.information = normal_equations(fit, sights).information;
  return fit;
}

}  // namespace onestroke
