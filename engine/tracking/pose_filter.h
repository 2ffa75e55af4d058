#pragma once

#include "core/pose.h"
#include "tracking/camera_model.h"

#include <array>
#include <cstddef>

namespace onestroke {

/// A pose and its covariance, of a left perturbation as in MarkerObservation.
struct PoseMeasurement {
  Pose pose;
  Matrix6d covariance = Matrix6d::Zero();
  bool as_expected = false;  ///< Detection's.
};

/// What the last measurements of one pose say together: the weighted mean of the longest run of them, from the newest
/// back, that agrees within the covariances with every shorter one (Lepski's choice of a window). What stands still
/// settles to the mean of many pictures; what moves is where the newest picture shows it, in that very picture. World
/// axes.
class PoseFilter {
 public:
  /// The most pictures that a mean is taken of.
  static constexpr int capacity = 64;

  struct Estimate : PoseMeasurement {
    int pictures = 0;  ///< That the mean is taken of; 0 where nothing is known.
  };

  void clear();
  /// Takes the next picture's measurement in, and with it a sharper one of the same picture where there is one. Those
  /// of each kind err in part alike while nothing moves, as edges stay where they are among the pixels.
  const Estimate& add(const PoseMeasurement& quick, const PoseMeasurement* sharp = nullptr);
  const Estimate& estimate() const { return estimate_; }

 private:
  struct Sample {
    Pose quick, sharp;
    Matrix6d quick_information, sharp_information;
    bool has_sharp = false;
  };
  /// The newest is 0.
  const Sample& back(int i) const { return samples_[static_cast<std::size_t>((next_ + capacity - 1 - i) % capacity)]; }

  std::array<Sample, capacity> samples_;
  int next_ = 0, count_ = 0;
  Estimate estimate_;
};

/// A covariance as PoseFilter has it, of axes that `rotation` turns into the wanted ones.
Matrix6d turned(const Matrix6d& covariance, Quat rotation);

}  // namespace onestroke
