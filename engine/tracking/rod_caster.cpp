#include "tracking/rod_caster.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

RodCaster::RodCaster(const RodModel& rod) : radius_(rod.radius()) {
  for (const Shape::Piece& p : rod.shape().pieces()) {
    const int parts = p.radius > 0 ? 6 : 1;
    for (int i = 0; i < parts; ++i) {
      const RodModel::Section a = rod.section_at(p.start + p.length * i / parts);
      const RodModel::Section b = rod.section_at(p.start + p.length * (i + 1) / parts);
      Piece q;
      q.a = a.centre;
      q.b = b.centre;
      q.length = (b.centre - a.centre).norm();
      q.axis = (b.centre - a.centre) / q.length;
      q.cut_a = a.cut;
      q.cut_b = b.cut;
      q.s0 = a.s;
      q.first = q.last = false;
      pieces_.push_back(q);
    }
  }
  pieces_.front().first = true;
  pieces_.back().last = true;
}

RodCaster::Hit RodCaster::cast(const Vec3d& eye, const Vec3d& direction) const {
  Hit best;
  double nearest = 1e300;
  const double dd = direction.squaredNorm();
  for (const Piece& p : pieces_) {
    const Vec3d m = eye - p.a;
    const double along = direction.dot(p.axis), start = m.dot(p.axis);
    const double a = dd - along * along, b = m.dot(direction) - start * along;
    const double c = m.squaredNorm() - start * start - radius_ * radius_;
    const double discriminant = b * b - a * c;
    if (discriminant >= 0 && a > 1e-12 * dd) {
      const double lambda = (-b - std::sqrt(discriminant)) / a;
      const Vec3d x = eye + lambda * direction;
      if (lambda > 0 && lambda < nearest && (x - p.a).dot(p.cut_a) >= 0 && (x - p.b).dot(p.cut_b) <= 0) {
        nearest = lambda;
        best = {true, p.s0 + std::clamp(start + lambda * along, 0.0, p.length), x, 0};
      }
    }
    const auto disc = [&](const Vec3d& centre, double facing, double s) {
      if (facing >= 0) return;
      const double lambda = (centre - eye).dot(p.axis) / along;
      const Vec3d x = eye + lambda * direction;
      if (lambda > 0 && lambda < nearest && (x - centre).squaredNorm() <= radius_ * radius_) {
        nearest = lambda;
        best = {true, s, x, 0};
      }
    };
    if (p.first) disc(p.a, -along, p.s0);
    if (p.last) disc(p.b, along, p.s0 + p.length);
    if (best.hit) continue;
    // The point of the axis nearest to the ray, kept to the piece; then the ray's point nearest to that.
    const double lambda = a > 1e-12 * dd ? -b / a : 0;
    const double q = std::clamp(start + lambda * along, 0.0, p.length);
    const Vec3d on_axis = p.a + q * p.axis;
    const Vec3d x = eye + direction * std::max(0.0, (on_axis - eye).dot(direction) / dd);
    const double gap = (x - on_axis).norm() - radius_;
    if (gap < best.gap) best = {false, p.s0 + q, x, gap};
  }
  if (best.hit) best.gap = 0;
  return best;
}

}  // namespace onestroke
