#pragma once

#include "scene/model.h"

#include <span>
#include <string>

namespace onestroke {

/// Decodes PNG, JPEG and what else is usual beside models (BMP, TGA). Returns what is wrong, "is damaged"; empty where
/// nothing is.
std::string decode_image(std::span<const std::uint8_t> bytes, ModelImage& image);

}  // namespace onestroke
