#pragma once

#include "scene/model_difference.h"

namespace onestroke {

/// The laid model's surface, each point in the colour of its distance to the base, by the ColorScale of the
/// statistics' reach. In the laid model's frame.
Model difference_map(const ComparedModel& laid, const ModelDifference& difference);

/// What the base has and the laid model lacks, as a veil: the base's surface, not there at all where the two coincide
/// or where it lies within the laid model, and ever less transparent with the distance. In the base's frame. Without
/// triangles where there is nothing to show.
Model difference_veil(const ComparedModel& base, const ModelDifference& difference);

/// How much the veil hides of what is behind it at most.
inline constexpr float veil_opacity = 0.35F;

}  // namespace onestroke
