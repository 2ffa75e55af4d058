#include "marker/centreline.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

constexpr double shortest_segment = 1e-6;  // mm
constexpr double straight_on = 1e-9;       // rad; a smaller turn is none
constexpr double sharpest_turn = 0.99 * std::numbers::pi;

using Piece = Shape::Piece;

/// What one inner vertex takes away from the straight pieces beside it.
struct Corner {
  double turn = 0;     ///< Angle between the directions before and after, rad.
  double tangent = 0;  ///< From the vertex to where the straight piece ends, mm.
  double needed = 0;   ///< The same, or the inner side of the mitre where that reaches further, mm.
};

Corner corner_between(Vec3 before, Vec3 after, double bend_radius, double rod_radius) {
  const double turn = std::atan2(norm(cross(before, after)), dot(before, after));
  if (turn < straight_on) return {};
  if (turn > sharpest_turn) throw Error("the stroke turns back on itself at a vertex; open that corner");
  const double k = std::tan(turn / 2);
  return {turn, bend_radius * k, std::max(bend_radius, rod_radius) * k};
}

Piece arc_at(Vec3 vertex, Vec3 before, Vec3 after, const Corner& corner, double bend_radius) {
  Piece arc;
  arc.origin = vertex - corner.tangent * before;
  arc.tangent = before;
  arc.normal = normalized(after - dot(after, before) * before);
  arc.radius = bend_radius;
  arc.length = bend_radius * corner.turn;
  return arc;
}

CentrelinePoint point_on(const Piece& piece, double s) {
  const double along = s - piece.start;
  if (piece.radius == 0) return {piece.origin + along * piece.tangent, piece.tangent};
  const double a = along / piece.radius;
  const Vec3 offset = std::sin(a) * piece.tangent + (1 - std::cos(a)) * piece.normal;
  return {piece.origin + piece.radius * offset, std::cos(a) * piece.tangent + std::sin(a) * piece.normal};
}

std::size_t piece_at(const std::vector<Piece>& pieces, double s) {
  const auto after = std::upper_bound(pieces.begin() + 1, pieces.end(), s,
                                      [](double value, const Piece& piece) { return value < piece.start; });
  return static_cast<std::size_t>(after - pieces.begin()) - 1;
}

/// Where the two straight pieces that share a corner with `piece` end: up to there a mitre or a bend is no overlap.
double end_of_neighbour(const std::vector<Piece>& pieces, std::size_t piece) {
  std::size_t last = piece + 1;
  if (last < pieces.size() && pieces[piece].radius == 0 && pieces[last].radius > 0) ++last;
  if (last >= pieces.size()) last = pieces.size() - 1;
  return pieces[last].start + pieces[last].length;
}

}  // namespace

std::vector<Piece> fillet(const std::vector<Vec3>& vertices, double bend_radius, double rod_radius) {
  std::vector<Vec3> directions;
  std::vector<double> lengths;
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    lengths.push_back(norm(vertices[i] - vertices[i - 1]));
    if (!(lengths.back() > shortest_segment)) throw Error("two neighbouring vertices coincide; leave one out");
    directions.push_back((vertices[i] - vertices[i - 1]) / lengths.back());
  }
  std::vector<Piece> pieces;
  Corner before;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const bool last = i + 1 == directions.size();
    const Corner after = last ? Corner{} : corner_between(directions[i], directions[i + 1], bend_radius, rod_radius);
    if (before.needed + after.needed > lengths[i] * (1 + 1e-12))
      throw Error(
          "the bends do not fit: a straight part is shorter than its corners need; lengthen it, or make the "
          "bend or the rod's radius smaller");
    Piece straight;
    straight.origin = vertices[i] + before.tangent * directions[i];
    straight.tangent = directions[i];
    straight.length = std::max(0.0, lengths[i] - before.tangent - after.tangent);
    pieces.push_back(straight);
    if (after.tangent > 0)
      pieces.push_back(arc_at(vertices[i + 1], directions[i], directions[i + 1], after, bend_radius));
    before = after;
  }
  for (std::size_t i = 1; i < pieces.size(); ++i) pieces[i].start = pieces[i - 1].start + pieces[i - 1].length;
  return pieces;
}

double total_length(const std::vector<Piece>& pieces) {
  return pieces.back().start + pieces.back().length;
}

CentrelinePoint point_at(const std::vector<Piece>& pieces, double s) {
  // A joint belongs to the piece that follows, also where rounding puts s just before it.
  const double rounding = 1e-9 * total_length(pieces);
  return point_on(pieces[piece_at(pieces, s + rounding)], s);
}

// A rod is free of overlap where every two points that are more than half a turn of the tightest bend (pi times the
// rod's radius) apart along the line are more than a diameter apart in space (the reach of the curve). Distances change
// at most as fast as arc length does, so the walk may skip by what a distance has to spare.
bool overlaps_itself(const std::vector<Piece>& pieces, double rod_radius) {
  const double diameter = 2 * rod_radius, least_step = rod_radius / 8, end = total_length(pieces);
  double s = 0;
  while (s < end) {
    const Vec3 here = point_at(pieces, s).position;
    double t = std::max(s + std::numbers::pi * rod_radius, end_of_neighbour(pieces, piece_at(pieces, s)));
    double spare = end;
    while (t <= end) {
      const double margin = norm(point_at(pieces, t).position - here) - diameter;
      if (margin < -1e-9 * diameter) return true;
      spare = std::min(spare, margin);
      t += std::max(margin, least_step);
    }
    s += std::max(std::min(spare, rod_radius), least_step);
  }
  return false;
}

}  // namespace onestroke
