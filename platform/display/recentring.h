#pragma once

#include "core/pose.h"

namespace onestroke {

/// What a head's pose becomes where it is taken for a place to look ahead from: the head's place, turned about the
/// vertical as the head is, and upright. Vision axes, the y axis pointing down. Where the head looks straight up or
/// down, its forehead or chin tells which way is ahead.
Pose upright(const Pose& T_world_head);

}  // namespace onestroke
