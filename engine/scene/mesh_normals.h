#pragma once

#include "scene/model.h"

#include <numbers>
#include <vector>

namespace onestroke {

/// Indexed triangles on the way into a Model.
struct Surface {
  std::vector<ModelVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< Three a triangle, all below vertices.size().
};

/// Edges of surfaces without normals stay hard from here on, radians; facets of round parts are finer.
inline constexpr double usual_crease = 35 * std::numbers::pi / 180;

void drop_empty_triangles(Surface& surface);

/// False where a normal has no direction; the others may have been changed then.
bool make_normals_unit(std::vector<ModelVertex>& vertices);

/// Gives every corner the mean of the faces about its point that lie within `crease` (radians) of its own face,
/// weighted by area, so that large flat faces stay flat beside fillets. Points at the same place count as one, whatever
/// the file's indices say; a vertex is split where its corners differ. Triangles without area are dropped.
void compute_normals(Surface& surface, double crease);

/// Tangents along the texture's u, one sign of w a triangle; a vertex is split where the texture is mirrored. Where the
/// texture coordinates say nothing, any direction across the normal. Needs normals.
void compute_tangents(Surface& surface);

/// Any unit tangent across each normal, for surfaces without a normal map.
void fill_tangents(Surface& surface);

/// Puts a surface behind another.
void append(const Surface& more, Surface& all);

}  // namespace onestroke
