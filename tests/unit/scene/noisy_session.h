#pragma once

#include "hand_motion.h"
#include "scene/comparison.h"
#include "stick_points.h"
#include "sticks.h"

#include <array>
#include <cstdint>

namespace onestroke {

inline constexpr double rate = 30;  // pictures a second

/// A comparison that sees what noisy eyes see of two sticks.
class Session {
 public:
  explicit Session(std::uint32_t seed) : eyes_(seed) {}

  const ComparisonView& show(const Pose& left, const Pose& right) {
    const double t = frame_ / rate;
    const auto seen = eyes_.see(left, right, t);
    std::array sticks{Stick{.id = 1}, Stick{.id = 2}};
    for (std::size_t i = 0; i < sticks.size(); ++i) {
      if (seen[i])
        sticks[i].place = seen[i]->translation, sticks[i].rotation = seen[i]->rotation;
      else
        sticks[i].state = MarkerState::lost;
    }
    return comparison_.update(record_of({sticks[0], sticks[1]}), Time{} + Duration::from_seconds(frame_++ / rate));
  }
  double seconds() const { return frame_ / rate; }
  Time now() const { return Time{} + Duration::from_seconds(seconds()); }
  void press(char key) { comparison_.press(key); }

 private:
  static CarriedModel carried(int id) {
    return {.marker_id = id,
            .pivot = {38, -30, 0},
            .reach = 35,
            .marker_from_model = {{0, 1, 0, 0}, {}, 1000},
            .points = stick_points};
  }

  const std::array<CarriedModel, 2> carried_{carried(1), carried(2)};
  Comparison comparison_{carried_};
  NoisyEyes eyes_;
  int frame_ = 0;
};

}  // namespace onestroke
