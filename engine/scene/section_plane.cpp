#include "scene/section_plane.h"

#include <algorithm>

namespace onestroke {

SectionPlane plane_of_stick(const Pose& T_world_marker, bool flipped) {
  const Vec3 normal = rotate(T_world_marker.rotation, {0, 0, flipped ? -1.0 : 1.0});
  return {normal, dot(normal, T_world_marker.translation)};
}

SectionPlane moved(const Similarity& target_from_source, const SectionPlane& plane) {
  const Vec3 normal = rotate(target_from_source.rotation, plane.normal);
  return {normal, dot(normal, target_from_source * (plane.offset * plane.normal))};
}

SectionPlane eased_in(const SectionPlane& plane, Vec3 middle, double reach, double amount) {
  const double before = std::min(plane.offset, dot(plane.normal, middle) - reach);
  return {plane.normal, before + amount * (plane.offset - before)};
}

}  // namespace onestroke
