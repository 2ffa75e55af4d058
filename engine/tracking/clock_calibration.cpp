#include "tracking/clock_calibration.h"

#include "core/error.h"
#include "tracking/hand_eye.h"
#include "tracking/head_path.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace onestroke {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr Duration gap = HeadPath::gap;
// How far apart the two of a pair are: long enough that the turn stands out of the noise, short enough to change.
constexpr Duration apart = Duration::from_ms(130);
constexpr Duration coarse = Duration::from_ms(4), settled = Duration::from_seconds(1e-5);
constexpr std::size_t stretches = 10;
constexpr double tukey = 4.685, normal_median = 0.6745;
// What the head's path between two of its poses leaves uncertain.
constexpr double path_ms = 0.02;
// A first guess of how well the head's poses are known.
constexpr double rough_rad = 0.01, rough_mm = 3;
// Normalised error squared of 6 degrees of freedom, which one of a thousand exceeds.
constexpr double agreement = 22.46;

[[noreturn]] void refuse_misfit() {
  throw Error(
      "head and pictures do not agree at any offset up to 150 ms: check that the marker lies still and that the head "
      "is "
      "the one that carries the camera");
}

/// Two sights a little apart.
struct Pair {
  std::size_t first = 0, second = 0;
  Eigen::Vector3d camera_turn;  // from the second's axes to the first's, in those
};

std::vector<Pair> pairs_of(std::span<const ClockSight> sights) {
  std::vector<Pair> pairs;
  std::size_t second = 0;
  for (std::size_t first = 0; first < sights.size(); ++first) {
    second = std::max(second, first);
    while (second + 1 < sights.size() && sights[second].time - sights[first].time < apart) ++second;
    const Duration span = sights[second].time - sights[first].time;
    if (span < apart || span > apart + gap) continue;
    const Quat from = sights[first].sight.T_camera_marker.rotation, to = sights[second].sight.T_camera_marker.rotation;
    pairs.push_back({first, second, to_eigen(log_so3(from * to.conjugate()))});
  }
  return pairs;
}

/// What is left between how camera and head turned, where the pictures were taken `offset` later.
class TurnMisfit {
 public:
  explicit TurnMisfit(std::span<const ClockSight> sights)
      : sights_(sights), path_(sights), pairs_(pairs_of(sights)), weights_(pairs_.size(), 1.0) {}

  std::size_t pairs() const { return pairs_.size(); }

  /// Weighted mean of the squares, rad^2.
  double cost(Duration offset) const {
    double weight = 0, sum = 0;
    const std::vector<std::optional<Eigen::Vector3d>> left = residuals(offset);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (!left[i]) continue;
      weight += weights_[i];
      sum += weights_[i] * left[i]->squaredNorm();
    }
    return weight > 0 ? sum / weight : HUGE_VAL;
  }

  /// Weighs the pairs by how well they agree (Tukey).
  void reweigh(Duration offset) {
    const auto left = residuals(offset);
    std::vector<double> lengths;
    for (const auto& r : left)
      if (r) lengths.push_back(r->norm());
    if (lengths.empty()) return;
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));
    const double reach = tukey * lengths[lengths.size() / 2] / normal_median;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const double u = left[i] && reach > 0 ? left[i]->norm() / reach : 0;
      weights_[i] = u < 1 ? (1 - u * u) * (1 - u * u) : 0;
    }
  }

 private:
  std::vector<std::optional<Eigen::Vector3d>> residuals(Duration offset) const {
    std::vector<std::optional<Eigen::Vector3d>> turns(pairs_.size());
    Eigen::Matrix3d together = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto from = path_.at(sights_[pairs_[i].first].time + offset);
      const auto to = path_.at(sights_[pairs_[i].second].time + offset);
      if (!from || !to) continue;
      turns[i] = to_eigen(log_so3(from->rotation.conjugate() * to->rotation));
      together += weights_[i] * pairs_[i].camera_turn * turns[i]->transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(together, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double proper = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    const Eigen::Matrix3d axes = svd.matrixU() * Eigen::Vector3d(1, 1, proper).asDiagonal() * svd.matrixV().transpose();
    for (std::size_t i = 0; i < turns.size(); ++i)
      if (turns[i]) turns[i] = pairs_[i].camera_turn - axes * *turns[i];
    return turns;
  }

  std::span<const ClockSight> sights_;
  HeadPath path_;
  std::vector<Pair> pairs_;
  std::vector<double> weights_;
};

/// The least between two times, by golden section.
template <typename Cost>
Duration least(Duration from, Duration to, const Cost& cost) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  const auto within = [&](double share) { return from + Duration::from_seconds(share * (to - from).seconds()); };
  Duration low = within(1 - golden), high = within(golden);
  double at_low = cost(low), at_high = cost(high);
  while (to - from > settled) {
    if (at_low < at_high) {
      to = high;
      high = low;
      at_high = at_low;
      low = within(1 - golden);
      at_low = cost(low);
    } else {
      from = low;
      low = high;
      at_low = at_high;
      high = within(golden);
      at_high = cost(high);
    }
  }
  return from + (to - from) / 2;
}

/// Within a few milliseconds.
Duration first_look(std::span<const ClockSight> sights) {
  TurnMisfit misfit(sights);
  if (misfit.pairs() < fewest_clock_sights)
    throw Error("the marker was seen in " + std::to_string(sights.size()) +
                " pictures that follow one another, which is too few: keep it in sight for ten seconds");
  Duration best;
  for (int round = 0; round < 2; ++round) {
    double cost = HUGE_VAL;
    for (Duration offset = -widest_clock_offset; offset <= widest_clock_offset; offset = offset + coarse) {
      const double here = misfit.cost(offset);
      if (here >= cost) continue;
      cost = here;
      best = offset;
    }
    misfit.reweigh(best);
  }
  if (best - coarse < -widest_clock_offset || best + coarse > widest_clock_offset) refuse_misfit();
  return best;
}

/// Everything fitted together where the pictures were taken `offset` later.
class WholeFit {
 public:
  WholeFit(std::span<const ClockSight> sights, Duration offset) : path_(sights) {
    for (const ClockSight& s : sights)
      if (path_.at(s.time + offset - reach) && path_.at(s.time + offset + reach)) sights_.push_back(s);
    if (sights_.size() < fewest_clock_sights) refuse_misfit();
    fit_.found = start_hand_eye(eigen_sights(offset, 0, 0));
    fit_.noise.variance = {rough_rad * rough_rad, rough_mm * rough_mm, 0, 0};
    settle(offset);
  }

  /// The noise, who agrees, and the poses, for this offset.
  void settle(Duration offset) {
    for (int round = 0; round < 2; ++round) {
      fit_.noise.estimated = {true, true, false, false};
      const std::vector<EigenSight> eigen = eigen_sights(offset, 0, 0);
      fit_ = fit_hand_eye(fit_, eigen);
      std::vector<ClockSight> agreeing;
      for (std::size_t i = 0; i < eigen.size(); ++i)
        if (disagreement(fit_, eigen[i]) < agreement) agreeing.push_back(sights_[i]);
      if (agreeing.size() < sights_.size() / 2) refuse_misfit();
      sights_ = std::move(agreeing);
    }
    fit_.noise.estimated = {};
  }

  std::size_t size() const { return sights_.size(); }

  /// Mean normalised square of what is left, without the sights of [from, to).
  double cost(Duration offset, std::size_t from = 0, std::size_t to = 0) const {
    const std::vector<EigenSight> eigen = eigen_sights(offset, from, to);
    const HandEyeFit fit = fit_hand_eye(fit_, eigen, 2);
    double sum = 0;
    for (const EigenSight& sight : eigen) sum += disagreement(fit, sight);
    return sum / static_cast<double>(eigen.size());
  }

  ClockOffset describe(Duration offset, double focal_px) const {
    ClockOffset found{.offset = offset, .deviation = {}, .used = sights_.size()};
    for (const EigenSight& sight : eigen_sights(offset, 0, 0)) {
      const Vector6d r = hand_eye_residual(fit_.found, sight);
      const double share = 1 / static_cast<double>(sights_.size());
      found.residual_deg += share * r.head<3>().squaredNorm();
      found.residual_px += share * r.segment<2>(3).squaredNorm() * std::pow(focal_px / sight.T_camera_marker.t.z(), 2);
    }
    found.residual_deg = std::sqrt(found.residual_deg) / degree;
    found.residual_px = std::sqrt(found.residual_px);
    return found;
  }

  static constexpr Duration reach = 3 * coarse;

 private:
  static double disagreement(const HandEyeFit& fit, const EigenSight& sight) {
    const Vector6d r = hand_eye_residual(fit.found, sight);
    return r.dot(hand_eye_covariance(fit.found, sight, fit.noise).ldlt().solve(r));
  }

  std::vector<EigenSight> eigen_sights(Duration offset, std::size_t from, std::size_t to) const {
    std::vector<EigenSight> eigen;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (i >= from && i < to) continue;
      HeadSight sight = sights_[i].sight;
      sight.T_world_head = *path_.at(sights_[i].time + offset);
      eigen.push_back(to_eigen(sight));
    }
    return eigen;
  }

  HeadPath path_;
  std::vector<ClockSight> sights_;
  HandEyeFit fit_;
};

Duration best_near(const WholeFit& fit, Duration offset, Duration reach, std::size_t from = 0, std::size_t to = 0) {
  return least(offset - reach, offset + reach, [&](Duration d) { return fit.cost(d, from, to); });
}

Duration jackknife(const WholeFit& fit, Duration offset) {
  std::vector<double> ms;
  for (std::size_t k = 0; k < stretches; ++k)
    ms.push_back(best_near(fit, offset, coarse / 2, k * fit.size() / stretches, (k + 1) * fit.size() / stretches).ms());
  double mean = 0, squares = 0;
  for (const double m : ms) mean += m / stretches;
  for (const double m : ms) squares += (m - mean) * (m - mean);
  return Duration::from_ms(std::hypot(std::sqrt(squares * (stretches - 1) / stretches), path_ms));
}

void check_turn(std::span<const ClockSight> sights) {
  if (median_turn_speed(sights) < slowest_clock_turn_deg_s * degree)
    throw Error("the head hardly turned: turn it to and fro, about once a second, with the marker in sight");
  std::vector<HeadSight> heads;
  for (const ClockSight& sight : sights) heads.push_back(sight.sight);
  if (head_turn(heads).second_deg < least_clock_turn_deg)
    throw Error("the head turned about one axis alone: nod as well as looking left and right");
}

}  // namespace

double median_turn_speed(std::span<const ClockSight> sights) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < sights.size(); ++i) {
    const Duration step = sights[i].time - sights[i - 1].time;
    if (step > Duration{} && step <= gap)
      speeds.push_back(angle_between(sights[i].sight.T_world_head.rotation, sights[i - 1].sight.T_world_head.rotation) /
                       step.seconds());
  }
  if (speeds.empty()) return 0;
  std::ranges::nth_element(speeds, speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2));
  return speeds[speeds.size() / 2];
}

ClockOffset find_clock_offset(std::span<const ClockSight> sights, double focal_px) {
  Duration offset = first_look(sights);
  check_turn(sights);
  WholeFit fit(sights, offset);
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    offset = best_near(fit, offset, WholeFit::reach);
    fit.settle(offset);
  }
  offset = best_near(fit, offset, WholeFit::reach);
  ClockOffset found = fit.describe(offset, focal_px);
  found.deviation = jackknife(fit, offset);
  return found;
}

}  // namespace onestroke
