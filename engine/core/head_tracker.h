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

/// A camera's place on somebody's head; on nobody's where `head` is null.
struct HeadMount {
  const HeadTracker* head = nullptr;
  Pose T_head_camera{};

  /// Where the camera was; none where that is not known. Any thread.
  std::optional<Pose> T_world_camera(Time time) const {
    const auto T_world_head = head ? head->head_at(time) : std::nullopt;
    return T_world_head ? std::optional(*T_world_head * T_head_camera) : std::nullopt;
  }
};

}  // namespace onestroke
