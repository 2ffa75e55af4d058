#pragma once

#include "scene/model.h"

namespace onestroke {

/// Makes a loaded model ready to be drawn fast: equal vertices become one, vertices without an index are left out,
/// triangles and vertices are put in the order that a GPU likes, and a model of many triangles gets levels of ever
/// half as many. Parts keep their order. Some seconds for a million triangles.
void add_levels(Model& model, const LoadProgress& progress = {});

}  // namespace onestroke
