#pragma once

#include "render/device.h"

namespace onestroke {

/// Whether the driver draws every view of a pass into its own layer: draws two views of four pixels and looks. Mesa
/// 22.3's software driver draws both into the first. Blocks.
bool multiview_works(Device& device);

}  // namespace onestroke
