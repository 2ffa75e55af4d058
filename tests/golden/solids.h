#pragma once

#include "scene/model.h"

namespace onestroke::golden {

/// Solids made by formula, with normals, tangents and texture coordinates. Metres.
Model torus(float ring_radius, float tube_radius, const ModelMaterial& material);
Model box(std::array<float, 3> half_size, const ModelMaterial& material);
/// Two triangles in the plane z = 0, facing +z.
Model sheet(float half_size, const ModelMaterial& material);

/// The one closed solid without the other, which lies within it. The first one's material.
Model hollow(const Model& outer, const Model& inner);

/// Textures: checks of two greys (sRGB), and a field of round bumps (normals).
ModelImage checks(int size, int cells);
ModelImage bumps(int size, int cells);

}  // namespace onestroke::golden
