#pragma once

#include "camera/key_path.h"
#include "camera/synthetic_options.h"

#include <span>

namespace onestroke {

/// What two hands do to show one way of comparing two models: what leads to it, the touch that it begins with, what it
/// is good for, its end; at last all is as it was at first.
struct ModeScript {
  double period = 0;  ///< Seconds.
  std::span<const Key> left, right;
  Orbit both;  ///< Turns both sticks as one.
  Orbit head;  ///< Takes the head round something.
};

/// Null where a script shows none. Written for sticks bent in the middle by 90 degrees, 72 mm an arm.
const ModeScript* find_mode_script(ScriptKind kind);

}  // namespace onestroke
