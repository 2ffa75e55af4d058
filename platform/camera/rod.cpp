#include "camera/rod.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace onestroke {
namespace {

constexpr double largest_bend_per_part = 0.1;  // rad: the chord then leaves an arc of radius 12 mm by 0.015 mm

}  // namespace

Rod::Rod(const MarkerSpec& spec) : spec_(spec) {
  for (std::size_t i = 0; i < spec_.shape.pieces().size(); ++i) add_piece(i);
}

Vec3 Rod::cut(double s) const {
  return normalized(spec_.shape.cut_normal(s));
}

void Rod::add_piece(std::size_t index) {
  const Shape& shape = spec_.shape;
  const Shape::Piece& piece = shape.pieces()[index];
  const double end = piece.start + piece.length;
  const double angle = piece.radius > 0 ? piece.length / piece.radius : 0.0;
  const int count = std::max(1, static_cast<int>(std::ceil(angle / largest_bend_per_part)));
  Group group{parts_.size(), 0, {}};
  for (int k = 0; k < count; ++k) {
    const double s0 = piece.start + piece.length * k / count, s1 = piece.start + piece.length * (k + 1) / count;
    const Vec3 p0 = k == 0 ? piece.origin : shape.at(s0).position;
    const Vec3 p1 = count == 1 ? p0 + piece.length * piece.tangent : shape.at(s1).position;
    const Vec3 n0 = -cut(s0), n1 = cut(s1);
    parts_.push_back({p0, normalized(p1 - p0), {n0, n1}, {dot(n0, p0), dot(n1, p1)}, index});
  }
  group.last = parts_.size();

  // A mitre reaches past the corner by the radius times the tangent of half the turn.
  const auto reach = [&](double s, Vec3 along) {
    const double c = std::abs(dot(cut(s), along));
    return radius() * std::sqrt(std::max(0.0, 1 - c * c)) / std::max(c, 0.1);
  };
  const double before = angle > 0 ? 0 : reach(piece.start, piece.tangent);
  const double after = angle > 0 ? 0 : reach(end, piece.tangent);
  const double covered = before + piece.length + after;
  const int balls = std::max(1, static_cast<int>(std::ceil(covered / radius())));
  for (int k = 0; k < balls; ++k) {
    const double s = piece.start - before + covered * (k + 0.5) / balls;
    const Vec3 p = angle > 0 ? shape.at(s).position : piece.origin + (s - piece.start) * piece.tangent;
    group.cover.push_back({p, std::hypot(radius(), 0.51 * covered / balls) + 0.05});
  }
  groups_.push_back(std::move(group));
}

Rod::Surface Rod::surface(const Part& part, int cap, Vec3 point) const {
  const Shape::Piece& piece = spec_.shape.pieces()[part.piece];
  Surface out;
  Vec3 on_centreline;
  if (piece.radius > 0) {
    const Vec3 from_centre = point - (piece.origin + piece.radius * piece.normal);
    const double angle = std::clamp(std::atan2(dot(from_centre, piece.tangent), -dot(from_centre, piece.normal)), 0.0,
                                    piece.length / piece.radius);
    out.s = piece.start + angle * piece.radius;
    on_centreline = piece.origin + piece.radius * piece.normal - (piece.radius * std::cos(angle)) * piece.normal +
                    (piece.radius * std::sin(angle)) * piece.tangent;
  } else {
    const double along = dot(point - piece.origin, piece.tangent);
    out.s = piece.start + std::clamp(along, 0.0, piece.length);
    on_centreline = piece.origin + along * piece.tangent;
  }
  out.normal = cap < 0 ? normalized(point - on_centreline) : part.normal[static_cast<std::size_t>(cap)];
  out.cell = std::clamp(static_cast<int>(out.s / spec_.shape.pitch()), 0, spec_.shape.cells() - 1);
  return out;
}

Vec3 Rod::centre() const {
  Vec3 low = spec_.shape.at(0).position, high = low;
  constexpr int steps = 64;
  for (int i = 1; i <= steps; ++i) {
    const Vec3 p = spec_.shape.at(spec_.shape.length() * i / steps).position;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return 0.5 * (low + high);
}

void PlacedRod::hold(const Rod& rod) {
  rod_ = &rod;
  starts_.resize(rod.parts().size());
}

void PlacedRod::look_from(Vec3 eye) {
  eye_ = eye;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const Rod::Part& part = rod_->parts()[i];
    const Vec3 offset = eye - part.origin;
    const Vec3 across = offset - dot(offset, part.axis) * part.axis;
    starts_[i] = {across,
                  dot(across, across) - rod_->radius() * rod_->radius(),
                  {part.offset[0] - dot(part.normal[0], eye), part.offset[1] - dot(part.normal[1], eye)}};
  }
}

bool PlacedRod::cast(std::size_t group, Vec3 direction, double limit, Hit& hit) const {
  const Rod::Group& g = rod_->groups()[group];
  const double length2 = dot(direction, direction);
  bool found = false;
  for (std::size_t i = g.first; i < g.last; ++i) {
    const Rod::Part& part = rod_->parts()[i];
    const Start& start = starts_[i];
    const double along = dot(direction, part.axis);
    const double a = length2 - along * along;
    const double b = dot(direction, start.across);
    const double discriminant = b * b - a * start.c;
    if (discriminant < 0) continue;
    double enter = 0, leave = std::numeric_limits<double>::max();
    int cap = -1;
    if (a > 1e-12 * length2) {
      const double root = std::sqrt(discriminant);
      enter = (-b - root) / a;
      leave = (-b + root) / a;
    } else if (start.c > 0) {
      continue;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const double slope = dot(part.normal[k], direction);
      const double t = start.room[k] / slope;
      if (slope < 0 && t > enter) {
        enter = t;
        cap = static_cast<int>(k);
      } else if (slope > 0) {
        leave = std::min(leave, t);
      } else if (slope == 0 && start.room[k] < 0) {
        leave = -1;
      }
    }
    if (enter >= leave || enter <= 0 || enter >= limit) continue;
    limit = enter;
    hit = {enter, i, cap};
    found = true;
  }
  return found;
}

}  // namespace onestroke
