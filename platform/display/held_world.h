#pragma once

#include "core/pose.h"

#include <cstdint>

namespace onestroke {

/// Where a space of the runtime's is in the world, which stays where it is among real things when the runtime moves the
/// space. Times are the runtime's, ns.
class HeldWorld {
 public:
  /// The space's place now, with nothing to come.
  void place(const Pose& T_world_space) {
    T_world_space_ = T_world_before_ = T_world_space;
    from_ = 0;
  }
  /// The space moves: from a time on, `T_before_after` is where its origin is in what it was before.
  void move(std::int64_t from, const Pose& T_before_after) {
    T_world_before_ = T_world_space_;
    T_world_space_ = T_world_before_ * T_before_after;
    from_ = from;
  }
  const Pose& T_world_space(std::int64_t time) const { return time < from_ ? T_world_before_ : T_world_space_; }

 private:
  Pose T_world_space_, T_world_before_;
  std::int64_t from_ = 0;
};

}  // namespace onestroke
