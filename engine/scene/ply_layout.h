#pragma once

#include "scene/file_bytes.h"

#include <string>

namespace onestroke {

/// Throws Error, naming the file, where the bytes are not a whole PLY mesh: a header that describes vertices with x, y
/// and z and faces, and behind it exactly so many numbers of them. A cloud of points is refused as that.
void check_ply(const std::string& file, const Bytes& bytes);

}  // namespace onestroke
