#pragma once

#include "scene/gltf_reader.h"
#include "scene/model.h"

namespace onestroke {

/// Fills vertices, indices and parts with the triangles of the file's scene, node transforms applied, one part a
/// material. Needs the materials; adds glTF's default material where a surface has none.
void read_geometry(const GltfReader& reader, Model& model);

}  // namespace onestroke
