#pragma once

#include "scene/file_bytes.h"
#include "scene/model.h"

namespace onestroke {

// Each fills materials, images and geometry from the bytes of a file, in the file's own units and axes. Files that the
// model names are looked for beside it. All throw Error that names the file.

void read_stl(const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model);
void read_obj(const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model);
void read_ply(const std::filesystem::path& file, Bytes bytes, const LoadProgress& progress, Model& model);

}  // namespace onestroke
