#pragma once

#include "render/view.h"
#include "shaders/shared.h"

#include <glm/mat4x4.hpp>

namespace onestroke {

/// Graphics view space to Vulkan's clip space (y down), reverse depth without a far end: 1 at the near plane, 0 at
/// infinity. Clip w is the depth in metres.
glm::mat4 projection_of(const Fov& fov, float near_metres);

/// One view's data; T_world_camera is where the picture that it sees was taken, which is the first one.
gpu::ViewData view_data(const View& view, const Pose& T_world_camera);

}  // namespace onestroke
