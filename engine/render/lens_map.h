#pragma once

#include "core/picture.h"

#include <array>
#include <vector>

namespace onestroke {

/// The largest squared radius (plane z = 1) up to which the lens model is monotonic; beyond it the model folds back
/// into the picture.
double distortion_limit(const Intrinsics& intrinsics);

/// The pixel of a point (x, y) of the plane z = 1, by OpenCV's model. Beyond distortion_limit() it goes on outwards in
/// a straight line, so that nothing is seen twice.
std::array<double, 2> through_lens(const Intrinsics& intrinsics, double x, double y);
/// The point of the plane z = 1 that a pixel sees.
std::array<double, 2> without_lens(const Intrinsics& intrinsics, double u, double v);

/// A rectangle of the plane z = 1 of the camera frame, (x, y) / z.
struct PlaneBounds {
  double left = -1, top = -1, right = 1, bottom = 1;
};

/// What of the plane z = 1 a picture shows, and `margin` picture heights more on every side.
PlaneBounds picture_bounds(const Intrinsics& intrinsics, int width, int height, double margin);

/// A rectangle of the plane z = 1 in which there is nothing but picture; of no size where the lens leaves none.
PlaneBounds inner_bounds(const Intrinsics& intrinsics, int width, int height);

/// How a lens shifts what an ideal one would show, sampled over the plane z = 1: looked up between samples it is right
/// to a hundredth of a pixel where the model does not fold within the picture.
struct LensMap {
  static constexpr int width = 256, height = 192;
  PlaneBounds bounds;
  /// Pairs: shift over the picture's width, over its height. Samples lie at the middles of the map's texels.
  std::vector<float> shifts;

  /// n to texture coordinates of the map: n * scale + offset, as {scale x, scale y, offset x, offset y}.
  std::array<float, 4> placement() const;
};

LensMap make_lens_map(const Intrinsics& intrinsics, int picture_width, int picture_height, const PlaneBounds& bounds);

}  // namespace onestroke
