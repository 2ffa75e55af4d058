#pragma once

#include "marker/shape.h"

#include <vector>

namespace onestroke {

/// The pieces of a polyline whose inner corners are fillets of bend_radius (mm; 0 leaves them sharp). A rod of
/// rod_radius must fit: throws Error where a corner takes more than its segments have, or where vertices coincide or
/// turn back.
std::vector<Shape::Piece> fillet(const std::vector<Vec3>& vertices, double bend_radius, double rod_radius);

double total_length(const std::vector<Shape::Piece>& pieces);

/// The point at arc length s, 0 <= s <= total_length(pieces).
CentrelinePoint point_at(const std::vector<Shape::Piece>& pieces, double s);

/// True where a rod of rod_radius along the pieces would run into itself.
bool overlaps_itself(const std::vector<Shape::Piece>& pieces, double rod_radius);

}  // namespace onestroke
