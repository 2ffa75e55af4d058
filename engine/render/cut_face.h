#pragma once

#include "render/frame_scene.h"
#include "render/screen_bounds.h"
#include "render/view.h"
#include "shaders/shared.h"

#include <span>

namespace onestroke {

/// Whether a view looks at a face that the instance's plane cuts its model open with, and that is to be filled. `box`
/// is round the model, in its own frame.
bool shows_cut(const ModelInstance& instance, const Box& box, std::span<const View> views);

/// A square that holds that face, seen from `eye` (world, graphics axes, metres). It is the same for all models that
/// one plane cuts, so that where their faces overlap the later hides the earlier. The hatch goes with the model.
gpu::CutData cut_face(const ModelInstance& instance, const Box& box, const glm::vec3& eye);

}  // namespace onestroke
