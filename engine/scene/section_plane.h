#pragma once

#include "scene/similarity.h"

namespace onestroke {

/// Keeps the side where dot(normal, p) >= offset; unit normal, mm.
struct SectionPlane {
  Vec3 normal{0, 0, 1};
  double offset = 0;
};

/// The plane in which both arms of a bent stick lie. `flipped`: keeps the side that the stick's z points away from.
SectionPlane plane_of_stick(const Pose& T_world_marker, bool flipped);

/// As the map moves it.
SectionPlane moved(const Similarity& target_from_source, const SectionPlane& plane);

/// Where the cut begins or ends: 0 leaves the ball whole, 1 cuts it as the plane says.
SectionPlane eased_in(const SectionPlane& plane, Vec3 middle, double reach, double amount);

}  // namespace onestroke
