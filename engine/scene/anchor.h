#pragma once

#include "core/pose.h"
#include "scene/model.h"

#include <glm/mat4x4.hpp>

namespace onestroke {

/// Where a model stands on an "angle" marker: on the stop arm, beside the start arm, inside the L. Marker frame, mm.
struct Anchor {
  Vec3 stand{38, -4, 0};  ///< Middle of the model's base: above the stop arm, whose rod reaches to y = -3.
  double size = 60;       ///< The bounding box's longest side; models are scaled to it as a whole.
};

/// The point that a model as high as it is large has at its centre; a model that is turned on its own turns about it.
inline constexpr Vec3 anchor_pivot{38, -34, 0};

/// From the model's own frame to the marker's frame in graphics axes and metres. The model's up is the marker's -y and
/// its front (+z in glTF) the marker's -z, so at marker rotation zero it is seen upright and from the front. Throws
/// Error where the model has no size.
glm::mat4 marker_graphics_from_model(const Model& model, const Anchor& anchor = {});

}  // namespace onestroke
