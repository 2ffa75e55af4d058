#pragma once

#include "scene/mesh_normals.h"

#include <glm/mat4x4.hpp>

namespace onestroke {

/// How one surface lies best on another.
struct BestFit {
  glm::dmat4 other_from_own{1.0};  ///< Rigid.
  double rms = 0;                  ///< Of the distances that count, in the surfaces' unit.
  bool settled = false;            ///< Another round would not have moved it.
};

/// Lays a surface on another one, moved and turned as a rigid body: least squares of the distances to the nearest
/// planes (Chen and Medioni 1992) of some thousand points, those that lie far from the others left out by Tukey's
/// weights, so that what was changed between two versions of a part does not move what was not. Tried from where the
/// two lie and with their middles and principal axes on each other, all four ways; where these come out alike, the one
/// from where they lie is taken. Neither may be without triangles. A second, near enough, for a million triangles each.
BestFit best_fit(const Surface& own, const Surface& other);

}  // namespace onestroke
