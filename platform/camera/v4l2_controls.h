#pragma once

#include "camera/live_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace onestroke {

/// Sets by V4L2 what libcamera does not reach on USB cameras: the white balance. `device` is the camera's node, empty
/// for none. What cannot be set is added to `shortfalls`, a line each.
void set_v4l2_controls(const std::filesystem::path& device, const LiveOptions& wishes,
                       std::vector<std::string>& shortfalls);

}  // namespace onestroke
