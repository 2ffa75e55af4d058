#pragma once

#include "scene/surface_difference.h"

#include <glm/vec3.hpp>

#include <functional>
#include <string>

namespace onestroke::bench {

/// Two surfaces whose distance is known. Metres.
struct DifferenceScene {
  std::string name;
  Surface own, other;
  /// From a point to the other surface, signed.
  std::function<double(const glm::dvec3&)> distance;
  double size = 0;  ///< Diagonal of the box round the larger one.
};

/// Balls about one centre, of 50 and 51 mm. Facets lie a little below the balls that their corners lie on: by the
/// square of their length over eight radii, 3 millionths of the size where there are a million. That is counted as
/// error.
DifferenceScene two_balls(int triangles);

/// A wavy ball that a box cuts through: of flat faces, the box is the same however many triangles it has.
DifferenceScene wavy_ball_and_box(int triangles);

glm::dvec3 position_of(const Surface& surface, std::size_t vertex);

/// Unsigned, by every triangle.
double brute_distance(const Surface& surface, const glm::dvec3& point);

/// Of all of own's vertices.
double largest_error(const DifferenceScene& scene, const SurfaceDifference& difference);

}  // namespace onestroke::bench
