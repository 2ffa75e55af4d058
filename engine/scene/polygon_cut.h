#pragma once

#include "scene/mesh_normals.h"

#include <cstdint>
#include <span>
#include <vector>

namespace onestroke {

/// Cuts a polygon, given by its corners in order, into triangles of the same turning sense and appends them, three
/// indices each. A concave one is cut so that nothing lies outside it; one that crosses itself is cut somehow. Less
/// than three corners make nothing.
void cut_polygon(const std::vector<ModelVertex>& vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::uint32_t>& triangles);

}  // namespace onestroke
