#pragma once

#include "scene/file_bytes.h"

#include <string>

namespace onestroke {

/// Throws Error, naming the file, where the bytes are no whole STL file, of either form. What lies beyond the last
/// triangle of a binary one is cut off; a text is brought to the spelling that readers agree on.
void prepare_stl(const std::string& file, Bytes& bytes);

}  // namespace onestroke
