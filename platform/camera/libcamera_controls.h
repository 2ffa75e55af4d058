#pragma once

#include "camera/live_options.h"

#include <libcamera/libcamera.h>

#include <string>
#include <vector>

namespace onestroke {

/// The controls that the wishes come to. What the camera lacks, or cannot do to that extent, is added to `shortfalls`,
/// a line each.
libcamera::ControlList controls_for(const libcamera::ControlInfoMap& offered, const LiveOptions& wishes,
                                    std::vector<std::string>& shortfalls);

}  // namespace onestroke
