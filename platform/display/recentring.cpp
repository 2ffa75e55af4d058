#include "display/recentring.h"

#include <cmath>

namespace onestroke {

namespace {

// The sine of how far from the vertical a head must look for that to tell which way is ahead.
constexpr double tells = 0.3;

}  // namespace

Pose upright(const Pose& T_world_head) {
  Vec3 ahead = rotate(T_world_head.rotation, {0, 0, 1});
  if (std::hypot(ahead.x, ahead.z) < tells) {
    const Vec3 forehead = rotate(T_world_head.rotation, {0, -1, 0});
    ahead = ahead.y > 0 ? forehead : -forehead;
  }
  return {exp_so3({0, std::atan2(ahead.x, ahead.z), 0}), T_world_head.translation};
}

}  // namespace onestroke
