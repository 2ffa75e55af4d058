#include "tracking/clock_calibration.h"

#include "core/error.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace onestroke {
namespace {

constexpr double degree = std::numbers::pi / 180;
// Sights further apart than this do not follow one another.
constexpr Duration gap = Duration::from_ms(150);
// How far apart the two of a pair are: long enough that the turn stands out of the noise, short enough to change.
constexpr Duration apart = Duration::from_ms(130);
constexpr Duration coarse = Duration::from_ms(4), settled = Duration::from_seconds(2e-6);
constexpr std::size_t stretches = 10;
constexpr double tukey = 4.685, normal_median = 0.6745;

Eigen::Vector3d vector_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// The head's rotation between sights: a cubic through neighbouring ones (Catmull and Rom) in the axes of the nearest.
class HeadPath {
 public:
  explicit HeadPath(std::span<const ClockSight> sights) : sights_(sights) {}

  /// None where no sights are near on both sides.
  std::optional<Quat> at(Time time) const {
    const auto after = std::ranges::upper_bound(sights_, time, {}, &ClockSight::time);
    if (after == sights_.begin() || after == sights_.end()) return std::nullopt;
    const auto i = static_cast<std::size_t>(after - sights_.begin());
    const ClockSight &a = sights_[i - 1], &b = sights_[i];
    if (b.time - a.time > gap) return std::nullopt;
    const double step = (b.time - a.time).seconds(), s = (time - a.time).seconds() / step;
    const Vec3 to = turn(a, b);
    const Vec3 slope_a = slope(i - 1, a, step, to), slope_b = slope(i, a, step, to);
    const double s2 = s * s, s3 = s2 * s;
    return a.T_world_head.rotation *
           exp_so3((s3 - 2 * s2 + s) * slope_a + (3 * s2 - 2 * s3) * to + (s3 - s2) * slope_b);
  }

 private:
  static Vec3 turn(const ClockSight& a, const ClockSight& b) {
    return log_so3(a.T_world_head.rotation.conjugate() * b.T_world_head.rotation);
  }
  /// Turn a step at sight i, in the axes of `origin`; where it has one neighbour alone, that of the step itself.
  Vec3 slope(std::size_t i, const ClockSight& origin, double step, const Vec3& to) const {
    if (i == 0 || i + 1 == sights_.size()) return to;
    const ClockSight &before = sights_[i - 1], &after = sights_[i + 1];
    const Duration span = after.time - before.time;
    if (span > 2 * gap) return to;
    return (step / span.seconds()) * (turn(origin, after) - turn(origin, before));
  }

  std::span<const ClockSight> sights_;
};

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
    const Quat from = sights[first].T_camera_marker.rotation, to = sights[second].T_camera_marker.rotation;
    pairs.push_back({first, second, vector_of(log_so3(from * to.conjugate()))});
  }
  return pairs;
}

/// What is left where the pictures were taken `offset` later.
class Misfit {
 public:
  Misfit(std::span<const ClockSight> sights, const std::vector<Pair>& pairs)
      : sights_(sights), path_(sights), pairs_(pairs), weights_(pairs.size(), 1.0) {}

  /// Weighted mean of the squares, rad^2; none where the head's path is not long enough. Pairs outside of [from, to)
  /// do not count, or those inside where `without`.
  double cost(Duration offset, std::size_t without_from = 0, std::size_t without_to = 0) const {
    double weight = 0, sum = 0;
    const std::vector<std::optional<Eigen::Vector3d>> left = residuals(offset, without_from, without_to);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (!left[i]) continue;
      weight += weights_[i];
      sum += weights_[i] * left[i]->squaredNorm();
    }
    return weight > 0 ? sum / weight : HUGE_VAL;
  }

  /// Weighs the pairs by how well they agree; the median of what is left, rad.
  double reweigh(Duration offset) {
    const auto left = residuals(offset, 0, 0);
    std::vector<double> lengths;
    for (const auto& r : left)
      if (r) lengths.push_back(r->norm());
    if (lengths.empty()) return 0;
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));
    const double median = lengths[lengths.size() / 2], reach = tukey * median / normal_median;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const double u = left[i] && reach > 0 ? left[i]->norm() / reach : 0;
      weights_[i] = u < 1 ? (1 - u * u) * (1 - u * u) : 0;
    }
    return median;
  }

  std::size_t used() const {
    return static_cast<std::size_t>(std::ranges::count_if(weights_, [](double w) { return w > 0; }));
  }

 private:
  std::vector<std::optional<Eigen::Vector3d>> residuals(Duration offset, std::size_t without_from,
                                                        std::size_t without_to) const {
    std::vector<std::optional<Eigen::Vector3d>> turns(pairs_.size());
    Eigen::Matrix3d together = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (i >= without_from && i < without_to) continue;
      const auto from = path_.at(sights_[pairs_[i].first].time + offset);
      const auto to = path_.at(sights_[pairs_[i].second].time + offset);
      if (!from || !to) continue;
      turns[i] = vector_of(log_so3(from->conjugate() * *to));
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
  const std::vector<Pair>& pairs_;
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

Duration search(const Misfit& misfit) {
  Duration best = -widest_clock_offset;
  double cost = HUGE_VAL;
  for (Duration offset = best; offset <= widest_clock_offset; offset = offset + coarse) {
    const double here = misfit.cost(offset);
    if (here >= cost) continue;
    cost = here;
    best = offset;
  }
  if (best - coarse < -widest_clock_offset || best + coarse > widest_clock_offset)
    throw Error(
        "head and pictures do not agree at any offset up to 150 ms: check that the marker lies still and that the head "
        "is the one that carries the camera");
  return best;
}

Duration jackknife(const Misfit& misfit, std::size_t pairs, Duration offset) {
  std::vector<double> ms;
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t from = k * pairs / stretches, to = (k + 1) * pairs / stretches;
    ms.push_back(least(offset - coarse, offset + coarse, [&](Duration d) { return misfit.cost(d, from, to); }).ms());
  }
  double mean = 0, squares = 0;
  for (const double m : ms) mean += m / stretches;
  for (const double m : ms) squares += (m - mean) * (m - mean);
  return Duration::from_ms(std::sqrt(squares * (stretches - 1) / stretches));
}

}  // namespace

double median_turn_speed(std::span<const ClockSight> sights) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < sights.size(); ++i) {
    const Duration step = sights[i].time - sights[i - 1].time;
    if (step > Duration{} && step <= gap)
      speeds.push_back(angle_between(sights[i].T_world_head.rotation, sights[i - 1].T_world_head.rotation) /
                       step.seconds());
  }
  if (speeds.empty()) return 0;
  std::ranges::nth_element(speeds, speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2));
  return speeds[speeds.size() / 2];
}

ClockOffset find_clock_offset(std::span<const ClockSight> sights) {
  const std::vector<Pair> pairs = pairs_of(sights);
  if (pairs.size() < fewest_clock_sights)
    throw Error("the marker was seen in " + std::to_string(sights.size()) +
                " pictures that follow one another, which is too few: keep it in sight for ten seconds");
  if (median_turn_speed(sights) < slowest_clock_turn_deg_s * degree)
    throw Error("the head hardly turned: turn it to and fro, about once a second, with the marker in sight");
  Misfit misfit(sights, pairs);
  Duration offset = search(misfit);
  double median = 0;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    median = misfit.reweigh(offset);
    offset = least(offset - coarse, offset + coarse, [&](Duration d) { return misfit.cost(d); });
  }
  return {.offset = offset,
          .deviation = jackknife(misfit, pairs.size(), offset),
          .used = misfit.used(),
          .residual_deg = median / degree};
}

}  // namespace onestroke
