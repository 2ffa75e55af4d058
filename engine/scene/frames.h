#pragma once

#include "core/pose.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace onestroke {

// The one place where vision (x right, y down, z forward, millimetres) meets graphics (x right, y up, z backward,
// metres). Both are right-handed; a half turn about x, F = diag(1, -1, -1), takes one to the other. A transform of
// graphics is F T F with its translation in metres, so matrices compose as the poses do: to_graphics(a * b) =
// to_graphics(a) * to_graphics(b).

inline constexpr double metres_per_millimetre = 1e-3;

/// T_target_source between vision frames, as the matrix between the same frames in graphics axes and metres.
glm::mat4 to_graphics(const Pose& T);

/// The inverse of to_graphics. The matrix must be rigid up to rounding.
Pose from_graphics(const glm::mat4& m);

/// The same for a transform that comes as a rotation and a translation in metres, as OpenXR's do.
Pose from_graphics(Quat rotation, Vec3 translation_m);

/// A direction, or a rate of turning, that comes so: only the axes change.
Vec3 direction_from_graphics(Vec3 d);

/// A point: vision mm to graphics m, and back.
glm::vec3 point_to_graphics(Vec3 p);
Vec3 point_from_graphics(const glm::vec3& p);

/// A direction keeps its length: only the axes change.
glm::vec3 direction_to_graphics(Vec3 d);
Vec3 direction_from_graphics(const glm::vec3& d);

}  // namespace onestroke
