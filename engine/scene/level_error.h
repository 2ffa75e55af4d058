#pragma once

#include "scene/model.h"

#include <cstdint>
#include <span>

namespace onestroke {

/// How far a coarser surface is off, in the vertices' unit: the largest distance by which, at the full one's vertices,
/// the surface has moved, its texture has slid, or a colour or a shade reaches that is not the full one's own; the last
/// but for one vertex in two hundred, as slivers have no shade to speak of. Measured at some ten thousand vertices
/// where there are more. `coarse` has three of the `vertices` a triangle.
double level_error(std::span<const ModelVertex> full, std::span<const ModelVertex> vertices,
                   std::span<const std::uint32_t> coarse);

}  // namespace onestroke
