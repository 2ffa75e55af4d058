#pragma once

#include "scene/mesh_normals.h"

#include <glm/mat4x4.hpp>

#include <functional>
#include <vector>

namespace onestroke {

/// What a surface measures by itself, in its own unit.
struct SurfaceMeasures {
  double area = 0;
  double volume = 0;    ///< What it encloses; without a meaning where it is not closed.
  bool closed = false;  ///< See SurfaceSides.
};

/// How far one surface lies from another, over its own area.
struct SurfaceDifference {
  /// From each of its vertices to the nearest point of the other surface: positive on the side that the other's
  /// normals face, which is the outside of a closed one.
  /// 0 where no triangle has the vertex.
  std::vector<float> distances;
  /// Of the distances, each counted by the area about its vertex; the last two of their sizes. Vertices that no
  /// triangle has do not count.
  double mean = 0, rms = 0, p95 = 0, most = 0;
  SurfaceMeasures own, other;
};

struct DifferenceOptions {
  int threads = 1;
  /// Told now and then how far it is, 0 to 1, by the caller's thread. What it throws ends the work and reaches the
  /// caller.
  std::function<void(double)> progress{};
};

/// Neither may be without triangles. other_from_own is rigid. The nearest points are exact, but for the rounding of the
/// floats that say where vertices are.
SurfaceDifference measure_difference(const Surface& own, const Surface& other, const glm::dmat4& other_from_own,
                                     const DifferenceOptions& options = {});

SurfaceMeasures measure(const Surface& surface);

}  // namespace onestroke
