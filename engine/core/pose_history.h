#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace onestroke {

/// Where something was, and where it will be by constant velocity. Keeps the newest `capacity` samples of one
/// transform.
///
/// Belongs to one thread; share what get() returns, not the history. Neither add() nor get() allocates.
class PoseHistory {
 public:
  enum class Kind {
    none,          ///< nothing known at that time
    exact,         ///< a sample of that very time
    interpolated,  ///< between two samples
    predicted,     ///< after the newest sample, within the horizon
  };

  struct Answer {
    Kind kind = Kind::none;
    /// For Kind::none the nearest that is known: the oldest sample, the prediction to the horizon, or the identity
    /// where there is no sample at all.
    Pose pose;
    Velocity velocity;  ///< Zero where it is unknown: a single sample that came without one.
  };

  /// How far past the newest sample a prediction is offered, unless told otherwise.
  static constexpr Duration usual_horizon = Duration::from_ms(100);

  /// Throws Error where the capacity is 0.
  explicit PoseHistory(std::size_t capacity, Duration horizon = usual_horizon);

  /// Samples may come out of order. One of a time already there takes its place; one older than all in a full history
  /// is left out. Without a velocity, the difference to the neighbouring sample is used.
  void add(Time time, const Pose& pose, std::optional<Velocity> velocity = std::nullopt);
  void clear() { size_ = 0; }

  Answer get(Time time) const;

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  /// Time of the newest sample; the history must not be empty.
  Time newest() const { return sample(size_ - 1).time; }

 private:
  struct Sample {
    Time time;
    Pose pose;
    std::optional<Velocity> velocity;
  };

  /// i = 0 is the oldest.
  Sample& sample(std::size_t i) { return ring_[(first_ + i) % ring_.size()]; }
  const Sample& sample(std::size_t i) const { return ring_[(first_ + i) % ring_.size()]; }
  std::size_t first_at_or_after(Time time) const;
  Velocity velocity_at(std::size_t i) const;
  Answer predict(Time time) const;

  std::vector<Sample> ring_;
  std::size_t first_ = 0, size_ = 0;
  Duration horizon_;
};

/// The velocity that carries a to b in `between`, which must not be 0.
Velocity velocity_between(const Pose& a, const Pose& b, Duration between);
/// The pose after moving on with a constant velocity.
Pose advance(const Pose& pose, const Velocity& velocity, Duration by);

}  // namespace onestroke
