#pragma once

#include "core/picture.h"
#include "tracking/image_view.h"

#include <vector>

namespace onestroke {

/// The picture as packed RGB: its own memory where it is RGB already, otherwise converted into storage (NV12, YUYV:
/// BT.601, limited range; grey: three equal channels, in which no ink can be told).
ImageView rgb_view(const Picture& picture, std::vector<std::uint8_t>& storage);

}  // namespace onestroke
