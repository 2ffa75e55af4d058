#pragma once

#include "render/view.h"

namespace onestroke {

/// From the world's origin, 45 degrees high: what a display without a camera to match shows.
inline View default_view(const Viewport& viewport) {
  constexpr double half_height = 0.41421356;  // tan(22.5 degrees)
  const double half_width = half_height * viewport.width / viewport.height;
  return {.T_world_view = {}, .fov = {-half_width, half_width, half_height, -half_height}, .viewport = viewport};
}

}  // namespace onestroke
