#pragma once

#include "core/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace onestroke {

/// A hand on its way from pose to pose, each move with the least jerk, with rests between and a tremor on it.
class HandMotion {
 public:
  HandMotion(std::uint32_t seed, double side) : random_(seed), side_(side) {
    from_ = to_ = anywhere();
    phase_ = uniform(0, 6);
  }

  Pose at(double seconds) {
    while (seconds > end_ + rest_) begin_move();
    const double u = std::clamp((seconds - start_) / (end_ - start_), 0.0, 1.0);
    const double s = u * u * u * (10 + u * (6 * u - 15));
    Pose T{interpolated(s), from_.translation + s * (to_.translation - from_.translation)};
    for (int k = 0; k < 3; ++k) {
      const double wave = std::sin(2 * std::numbers::pi * (7.5 + k) * seconds + phase_ + k);
      (k == 0 ? T.translation.x : k == 1 ? T.translation.y : T.translation.z) += 0.5 * wave;
    }
    return T;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  Quat interpolated(double s) const {
    return exp_so3(s * log_so3(to_.rotation * from_.rotation.conjugate())) * from_.rotation;
  }
  // In front of the wearer, each hand on its own side and a little beyond the middle.
  Pose anywhere() {
    return {exp_so3({uniform(-1.5, 1.5), uniform(-1.5, 1.5), uniform(-1.5, 1.5)}),
            {side_ * uniform(-20, 220), uniform(-130, 130), uniform(380, 520)}};
  }
  void begin_move() {
    start_ = end_ + rest_;
    end_ = start_ + uniform(0.4, 1.6);
    rest_ = uniform(0, 2.5);
    from_ = to_;
    to_ = anywhere();
  }

  std::mt19937 random_;
  double side_, start_ = -1, end_ = 0, rest_ = 0, phase_ = 0;
  Pose from_, to_;
};

/// The tracker: noise, more along the line of sight, times at which it sees neither stick, and times at which a hand
/// covers one.
class NoisyEyes {
 public:
  explicit NoisyEyes(std::uint32_t seed) : random_(seed) {}

  std::array<std::optional<Pose>, 2> see(const Pose& left, const Pose& right, double seconds) {
    const bool dropped = drop_out_.lasts(seconds, random_, 0.3);
    const std::array covered{covers_[0].lasts(seconds, random_, 0.2), covers_[1].lasts(seconds, random_, 0.2)};
    std::array<std::optional<Pose>, 2> seen{noisy(left), noisy(right)};
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (dropped || covered[i]) seen[i].reset();
    return seen;
  }

 private:
  /// Comes and goes.
  struct Gap {
    double next = 1, ends = 0;

    bool lasts(double seconds, std::mt19937& random, double longest) {
      const auto uniform = [&random](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
      };
      if (seconds > next) {
        ends = seconds + uniform(0.03, longest);
        next = ends + uniform(0.5, 6);
      }
      return seconds < ends;
    }
  };

  Pose noisy(Pose T) {
    std::normal_distribution<double> one(0, 1);
    T.translation = T.translation + Vec3{0.1 * one(random_), 0.1 * one(random_), 0.6 * one(random_)};
    T.rotation = exp_so3({0.004 * one(random_), 0.004 * one(random_), 0.004 * one(random_)}) * T.rotation;
    return T;
  }

  std::mt19937 random_;
  Gap drop_out_;
  std::array<Gap, 2> covers_;
};

}  // namespace onestroke
