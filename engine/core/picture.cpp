#include "core/picture.h"

#include <cmath>

namespace onestroke {

Intrinsics Intrinsics::from_fov(int width, int height, double horizontal_fov_rad) {
  Intrinsics k;
  k.fx = k.fy = 0.5 * width / std::tan(horizontal_fov_rad / 2);
  k.cx = 0.5 * width;
  k.cy = 0.5 * height;
  return k;
}

}  // namespace onestroke
