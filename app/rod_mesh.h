#pragma once

#include "marker/shape.h"
#include "scene/model.h"

namespace onestroke {

/// A marker's rod as a closed mesh: marker frame in graphics axes and metres (see scene/frames.h), one part, one plain
/// material. What is hidden behind a real stick is hidden behind this.
Model rod_mesh(const Shape& shape);

}  // namespace onestroke
