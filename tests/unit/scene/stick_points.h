#pragma once

#include "scene/touch_gesture.h"

namespace onestroke {

/// Of a stick that is bent in its middle by 90 degrees, in its own frame; mm.
inline constexpr double arm = 72;
inline constexpr StickPoints stick_points{Vec3{0, -arm, 0}, Vec3{}, Vec3{arm, 0, 0}};

}  // namespace onestroke
