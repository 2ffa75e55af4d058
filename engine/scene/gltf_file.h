#pragma once

#include "scene/file_bytes.h"
#include "scene/model.h"

namespace onestroke {

/// Fills materials, images and geometry from a .glb or .gltf. Throws Error that names the file.
void read_gltf(const std::filesystem::path& file, Bytes bytes, Model& model);

}  // namespace onestroke
