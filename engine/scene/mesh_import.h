#pragma once

#include "scene/file_bytes.h"
#include "scene/model.h"

#include <string>

namespace onestroke {

/// How to read one of the formats that Assimp reads.
struct MeshFormat {
  std::string extension;      ///< ".stl"
  bool keeps_normals = true;  ///< Otherwise those of the file are not looked at.
};

/// Fills materials, images and geometry from bytes that are known to be laid out well. Nothing that Assimp returns is
/// trusted: numbers must be finite and indices in range. Throws Error that names the file.
void import_mesh(const std::filesystem::path& file, Bytes bytes, const MeshFormat& format, const LoadProgress& progress,
                 Model& model);

}  // namespace onestroke
