#include "marker/shape.h"

#include "core/error.h"
#include "marker/centreline.h"
#include "marker/color_code.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace onestroke {
namespace {

constexpr double length_tolerance = 0.01;  // mm; what rounded vertices may be off by
constexpr double most_slender = 100;       // pitch over radius
constexpr double longest_pitch = 1000;     // mm

template <typename... Parts>
[[noreturn]] void fail(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw Error(text.str());
}

void check_rod(int cells, double pitch, double radius, double bend_radius) {
  if (cells < 3 || cells > max_cells) fail("a rod has 3 to ", max_cells, " cells, not ", cells);
  if (!(pitch > 0 && pitch <= longest_pitch))
    fail("the pitch must be a positive number of millimetres up to ", longest_pitch, ", not ", pitch);
  if (!(std::isfinite(radius) && radius > 0)) fail("the radius must be a positive number of millimetres, not ", radius);
  if (radius * most_slender < pitch)
    fail("the radius must be at least a hundredth of the pitch of ", pitch, " mm, not ", radius);
  if (!(std::isfinite(bend_radius) && bend_radius >= 0))
    fail("the bend radius must be 0 or a positive number of millimetres, not ", bend_radius);
}

bool finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

Shape Shape::angle(int cells, double pitch, double radius, double bend_radius) {
  check_rod(cells, pitch, radius, bend_radius);
  if (cells % 2 != 0) fail("an angle has an even number of cells, half of them on each arm, not ", cells);
  Shape shape;
  shape.kind_ = Kind::angle;
  shape.cells_ = cells, shape.pitch_ = pitch, shape.radius_ = radius, shape.bend_radius_ = bend_radius;
  const double straight = shape.length() / 2 - std::numbers::pi * bend_radius / 4;
  if (straight < 0)
    fail("a bend radius of ", bend_radius, " mm does not fit; arms of ", shape.length() / 2, " mm allow at most ",
         2 * shape.length() / std::numbers::pi, " mm");
  const double tip = straight + bend_radius;
  shape.vertices_ = {{0, -tip, 0}, {0, 0, 0}, {tip, 0, 0}};
  shape.pieces_ = fillet(shape.vertices_, bend_radius, radius);
  return shape;
}

Shape Shape::stroke(int cells, double pitch, double radius, double bend_radius, std::vector<Vec3> vertices) {
  check_rod(cells, pitch, radius, bend_radius);
  if (vertices.size() < 2) fail("a stroke has at least 2 vertices, not ", vertices.size());
  if (!std::all_of(vertices.begin(), vertices.end(), finite)) fail("a vertex is not a finite point");
  Shape shape;
  shape.kind_ = Kind::stroke;
  shape.cells_ = cells, shape.pitch_ = pitch, shape.radius_ = radius, shape.bend_radius_ = bend_radius;
  shape.vertices_ = std::move(vertices);
  shape.pieces_ = fillet(shape.vertices_, bend_radius, radius);
  const double drawn = total_length(shape.pieces_);
  if (std::abs(drawn - shape.length()) > length_tolerance)
    fail("a stroke of ", cells, " cells of ", pitch, " mm is ", shape.length(), " mm long, but its vertices give ",
         drawn, " mm; move a vertex or change the pitch");
  Piece& last = shape.pieces_.back();
  last.length = std::max(0.0, shape.length() - last.start);
  if (overlaps_itself(shape.pieces_, radius)) fail("the stroke overlaps itself; move its vertices further apart");
  return shape;
}

Shape Shape::line(int cells, double pitch, double radius) {
  check_rod(cells, pitch, radius, 0);
  Shape shape;
  shape.kind_ = Kind::line;
  shape.cells_ = cells, shape.pitch_ = pitch, shape.radius_ = radius;
  shape.vertices_ = {{-shape.length() / 2, 0, 0}, {shape.length() / 2, 0, 0}};
  shape.pieces_ = fillet(shape.vertices_, 0, radius);
  return shape;
}

CentrelinePoint Shape::at(double s) const {
  return point_at(pieces_, std::clamp(s, 0.0, length()));
}

Vec3 Shape::cut_normal(double s) const {
  const double close = 1e-9 * length();
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const Piece& before = pieces_[i - 1];
    const Piece& after = pieces_[i];
    if (std::abs(s - after.start) > close) continue;
    const Vec3 arriving = before.radius == 0 ? before.tangent : after.tangent;
    return normalized(arriving + after.tangent);
  }
  return at(s).tangent;
}

bool Shape::has_roll() const {
  return std::any_of(pieces_.begin(), pieces_.end(), [this](const Piece& piece) {
    return piece.radius > 0 || norm(cross(piece.tangent, pieces_.front().tangent)) > 1e-9;
  });
}

}  // namespace onestroke
