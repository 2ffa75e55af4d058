#include "camera/lens.h"

#include <cmath>

namespace onestroke {
namespace {

/// OpenCV's distortion of a point of the plane z = 1.
Point2 bend(const Intrinsics& k, Point2 p) {
  const auto& [k1, k2, p1, p2, k3] = k.distortion;
  const double r2 = p.x * p.x + p.y * p.y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {p.x * radial + 2 * p1 * p.x * p.y + p2 * (r2 + 2 * p.x * p.x),
          p.y * radial + p1 * (r2 + 2 * p.y * p.y) + 2 * p2 * p.x * p.y};
}

}  // namespace

Point2 distort(const Intrinsics& k, Point2 p) {
  if (k.distorted()) p = bend(k, p);
  return {k.fx * p.x + k.cx, k.fy * p.y + k.cy};
}

Point2 undistort(const Intrinsics& k, Point2 pixel) {
  const Point2 target{(pixel.x - k.cx) / k.fx, (pixel.y - k.cy) / k.fy};
  if (!k.distorted()) return target;
  // Far outside the picture a lens model may bend back on itself and the steps run away; the nearest one counts then.
  Point2 p = target, nearest = target;
  double least = 1e300;
  constexpr int most_steps = 20;
  for (int i = 0; i < most_steps; ++i) {
    const Point2 seen = bend(k, p);
    const Point2 miss{target.x - seen.x, target.y - seen.y};
    const double size = std::abs(miss.x) + std::abs(miss.y);
    if (!(size < least)) break;
    least = size;
    nearest = p;
    if (size < 1e-9) break;
    p = {p.x + miss.x, p.y + miss.y};
  }
  return nearest;
}

}  // namespace onestroke
