#pragma once

#include "scene/mesh_normals.h"

#include <cstddef>

namespace onestroke {

struct Refinement {
  double longest_edge = 0;  ///< More than 0, in the surface's unit.
  std::size_t most_triangles = 300'000;
};

/// The same surface with vertices close enough to each other to tell something at each: edges that are longer than said
/// are halved until none is, and triangles are cut in two, three or four with them. Where that would make too many
/// triangles, edges may be longer; what has too many already stays as it is. Whether an edge is halved, and where,
/// hangs on its two ends alone, so that what was closed stays closed. Normals, texture coordinates and colours are
/// interpolated.
Surface refine(const Surface& surface, const Refinement& refinement);

}  // namespace onestroke
