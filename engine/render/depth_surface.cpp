#include "render/depth_surface.h"

#include "scene/frames.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

// In the plane z = 1. Nearer than this to a segment its depth rules alone; about half a stick's thickness.
constexpr double softness = 0.008;
// So far from every segment the set distance counts as much as they do.
constexpr double reach = 0.35;
// What is nearer to the camera, or beside it, has no place in the picture; mm.
constexpr double nearest = 20;

bool counts(const DepthSegment& s) {
  return s.weight > 0 && s.from.z > nearest && s.to.z > nearest;
}

/// A point in the direction of `to`, no steeper from `from` than 45 degrees.
Vec3 held_back(Vec3 from, Vec3 to) {
  const double sideways = std::hypot(to.x - from.x, to.y - from.y);
  const double z = from.z + std::clamp(to.z - from.z, -sideways, sideways);
  // It stays where the picture shows it.
  return to.z > nearest ? z / to.z * to : to;
}

}  // namespace

double SurfaceAxis::at(int i) const {
  if (i == 0) return outer_from;
  return i == cells ? outer_to : from + (i - 1) * step();
}

double SurfaceAxis::cell_of(double place) const {
  const auto share = [place](double begin, double end) {
    return end > begin ? std::clamp((place - begin) / (end - begin), 0.0, 1.0) : 0;
  };
  if (place < from) return share(outer_from, from);
  if (place < to) return 1 + share(from, to) * (cells - 2);
  return cells - 1 + share(to, outer_to);
}

std::size_t chain_segments(std::span<const Vec3> points, double weight, std::span<DepthSegment> segments) {
  if (points.size() < 2) return 0;
  std::size_t count = 0;
  const auto add = [&](Vec3 from, Vec3 to) {
    if (count < segments.size()) segments[count++] = {from, to, weight};
  };
  const std::size_t middle = points.size() / 2;  // never the first
  Vec3 at = points[middle];
  for (std::size_t i = middle; i-- > 0;) {
    const Vec3 next = held_back(at, points[i]);
    add(next, at);
    at = next;
  }
  if (count > 0) segments.front().pin = DepthSegment::Pin::to;
  at = points[middle];
  for (std::size_t i = middle + 1; i < points.size(); ++i) {
    const Vec3 next = held_back(at, points[i]);
    add(at, next);
    at = next;
  }
  return count;
}

double DepthSurface::inverse_depth(double x, double y, std::size_t known) const {
  double weight = 1 / (reach * reach * reach * reach), sum = weight * far_;
  for (std::size_t i = 0; i < known; ++i) {
    const Known& s = segments_[i];
    const double px = x - s.x, py = y - s.y;
    const double along = std::clamp((px * s.dx + py * s.dy) * s.per_length2, 0.0, 1.0);
    const double off_x = px - along * s.dx, off_y = py - along * s.dy;
    const double d2 = off_x * off_x + off_y * off_y + softness * softness;
    const double w = 1 / (d2 * d2);
    weight += w;
    sum += w * (s.q + along * s.dq);
  }
  return sum / weight;
}

void DepthSurface::add(const DepthSegment& s, std::size_t settled) {
  if (!counts(s) || known_ == segments_.size()) return;
  const double ax = s.from.x / s.from.z, ay = s.from.y / s.from.z, bx = s.to.x / s.to.z, by = s.to.y / s.to.z;
  double from = 1 / s.from.z, to = 1 / s.to.z;
  if (s.weight < 1) {
    // On its way from where the surface would be without it.
    from += (1 - s.weight) * (inverse_depth(ax, ay, settled) - from);
    to += (1 - s.weight) * (inverse_depth(bx, by, settled) - to);
  }
  const double dx = bx - ax, dy = by - ay, length2 = dx * dx + dy * dy;
  segments_[known_++] = {ax, ay, dx, dy, length2 > 0 ? 1 / length2 : 0, from, to - from};
}

void DepthSurface::build(const PlaneBounds& inside, const PlaneBounds& around, std::span<const DepthSegment> segments,
                         double distance, bool in_cells) {
  far_ = 1 / distance;
  known_ = 0;
  for (const DepthSegment& s : segments)
    if (s.weight >= 1) add(s, 0);
  const std::size_t settled = known_;
  for (const DepthSegment& s : segments)
    if (s.weight < 1) add(s, settled);
  const bool one = known_ == 0 && !in_cells;
  across_ = {around.left, inside.left, inside.right, around.right, one ? 3 : columns};
  down_ = {around.top, inside.top, inside.bottom, around.bottom, one ? 3 : rows};
  fill();
  for (const DepthSegment& s : segments) {
    if (s.pin == DepthSegment::Pin::none || !counts(s)) continue;
    const Vec3 at = s.pin == DepthSegment::Pin::from ? s.from : s.to;
    pin(at.x / at.z, at.y / at.z, s.weight < 1 ? inverse_depth(at.x / at.z, at.y / at.z) : 1 / at.z);
  }
}

void DepthSurface::fill() {
  std::size_t at = 0;
  for (int row = 0; row <= down_.cells; ++row)
    for (int column = 0; column <= across_.cells; ++column)
      values_[at++] = static_cast<float>(inverse_depth(across_.at(column), down_.at(row)) / metres_per_millimetre);
}

// 1 / depth is affine over each of a cell's two triangles, which share the edge from bottom left to top right. The
// three corners move in proportion to their share in the place.
void DepthSurface::pin(double x, double y, double q) {
  const double u = across_.cell_of(x), v = down_.cell_of(y);
  if (!(u > 0 && v > 0 && u < across_.cells && v < down_.cells)) return;
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const double s = u - column, t = v - row;
  const auto corner = [this](int r, int c) { return static_cast<std::size_t>(r * (across_.cells + 1) + c); };
  const bool upper = s + t < 1;
  const std::array corners{upper ? corner(row, column) : corner(row + 1, column + 1), corner(row, column + 1),
                           corner(row + 1, column)};
  const std::array shares{upper ? 1 - s - t : s + t - 1, upper ? s : 1 - t, upper ? t : 1 - s};
  double drawn = 0, squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    drawn += shares[i] * double{values_[corners[i]]};
    squares += shares[i] * shares[i];
  }
  const double missing = (q / metres_per_millimetre - drawn) / squares;
  for (std::size_t i = 0; i < 3; ++i) values_[corners[i]] += static_cast<float>(shares[i] * missing);
}

}  // namespace onestroke
