#pragma once

#include "core/pose.h"
#include "scene/model.h"
#include "scene/similarity.h"

#include <glm/mat4x4.hpp>

#include <optional>

namespace onestroke {

/// Where a model stands on a marker, at least: on the stop arm, beside the start arm, inside the L. Marker frame, mm.
/// The middle of the model's base: above the stop arm, whose rod reaches to y = -3. A wide model stands farther out, so
/// that it keeps clear of the start arm.
inline constexpr Vec3 anchor_stand{38, -4, 0};

/// How a model stands on its marker.
struct Placement {
  /// From the model's own frame to the marker's in graphics axes and metres. The model's up is the marker's -y and its
  /// front (+z in glTF) the marker's -z, so at marker rotation zero it is seen upright and from the front.
  glm::mat4 marker_graphics_from_model{1};
  Similarity marker_from_model{};  ///< The same for points in vision axes, from the model's metres to mm.
  Vec3 pivot{};      ///< The middle of the model, marker frame, mm: a model that is turned on its own turns about it.
  double reach = 0;  ///< No part of the model is farther from the pivot, mm.
};

/// In its true size, or with its longest side as long as `fit` says, mm. Throws Error where the model has no size.
Placement place_on_marker(const Model& model, std::optional<double> fit = {});

}  // namespace onestroke
