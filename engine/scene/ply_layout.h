#pragma once

#include "scene/file_bytes.h"

#include <string>

namespace onestroke {

/// Throws Error, naming the file, where the bytes are not a whole PLY mesh: a header that describes vertices with x, y
/// and z and faces, and behind it at least so many numbers of them. A cloud of points is refused as that. Numbers that
/// begin with a byte that ends a line in text get another before them, as Assimp passes over one.
void prepare_ply(const std::string& file, Bytes& bytes);

}  // namespace onestroke
