#pragma once

#include "core/picture.h"

namespace onestroke {

/// A point of the plane z = 1 of the camera frame, or a pixel.
struct Point2 {
  double x = 0, y = 0;
};

/// The pixel of a point of the plane z = 1.
Point2 distort(const Intrinsics& k, Point2 p);
/// The point of the plane z = 1 that a pixel sees.
Point2 undistort(const Intrinsics& k, Point2 pixel);

}  // namespace onestroke
