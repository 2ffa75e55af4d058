#pragma once

#include "core/pose.h"

#include <numbers>
#include <random>

namespace onestroke::test {

/// Seeded random poses; the same in every run.
class RandomPose {
 public:
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return normalized(Vec3{normal(engine_), normal(engine_), normal(engine_)});
  }
  Vec3 vector(double reach) { return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)}; }
  /// A rotation vector of the given angle about any axis.
  Vec3 turn(double angle) { return angle * direction(); }
  Quat rotation() { return exp_so3(turn(uniform(0, std::numbers::pi))); }
  Pose pose() { return {rotation(), vector(500)}; }

 private:
  std::mt19937_64 engine_{42};
};

}  // namespace onestroke::test
