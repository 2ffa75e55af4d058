#pragma once

#include "scene/mesh_normals.h"

#include <cstdint>
#include <vector>

namespace onestroke {

/// A number for each vertex, equal where the positions are; from 0 without gaps.
struct Places {
  std::vector<std::uint32_t> of_vertex;
  std::size_t count = 0;
};
Places find_places(const Surface& surface);

/// Makes one of vertices that are equal in everything, and leaves out those without an index.
void weld(Surface& surface);

}  // namespace onestroke
