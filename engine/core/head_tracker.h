#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <optional>

namespace onestroke {

/// Whoever knows where the wearer's head was.
class HeadTracker {
 public:
  virtual ~HeadTracker() = default;

  /// T_world_head, the head's axes being those of a view straight ahead, at a time of late or soon; none where it is
  /// not known. Any thread.
  virtual std::optional<Pose> head_at(Time time) const = 0;
};

}  // namespace onestroke
