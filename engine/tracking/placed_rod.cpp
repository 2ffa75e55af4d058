#include "tracking/placed_rod.h"

#include <Eigen/Geometry>

namespace onestroke {
namespace {

void place(const RodModel::Section& s, const EigenPose& pose, PlacedSection& p) {
  p.centre = pose * s.centre;
  p.tangent = pose.R * s.tangent;
  p.front = p.tangent * p.centre.dot(p.tangent) - p.centre;
  const double length = p.front.norm();
  // Looking straight down the axis no side faces the eye; any will do.
  p.front = length > 1e-9 ? Vec3d(p.front * (1 / length)) : p.tangent.unitOrthogonal();
  p.side = p.tangent.cross(p.front);
}

void place_cut(const RodModel::Section& s, const EigenPose& pose, PlacedSection& p) {
  p.square = s.cut == s.tangent;
  p.cut = p.square ? p.tangent : Vec3d(pose.R * s.cut);
  p.along = p.square ? 1 : p.tangent.dot(p.cut);
}

}  // namespace

PlacedRod::PlacedRod(const RodModel& rod, const EigenPose& pose) : radius_(rod.radius()) {
  const int n = rod.cell_count();
  const RodModel::Section* before = nullptr;
  const PlacedSection* placed = nullptr;
  const auto next = [&](const RodModel::Section& s, PlacedSection& p) {
    if (before && s.tangent == before->tangent) {
      // On along a straight arm: the same side faces the eye.
      p = *placed;
      p.centre += (s.s - before->s) * p.tangent;
    } else {
      place(s, pose, p);
    }
    place_cut(s, pose, p);
    before = &s;
    placed = &p;
  };
  for (int c = 0; c <= n; ++c) {
    next(rod.edge(c), edges_[static_cast<std::size_t>(c)]);
    if (c == n) break;
    next(rod.middle(c), middles_[static_cast<std::size_t>(c)]);
    const Vec3d& tangent = rod.middle(c).tangent;
    prism_[static_cast<std::size_t>(c)] = rod.edge(c).cut == tangent && rod.edge(c + 1).cut == tangent;
  }
}

Vec3d PlacedRod::middle_of(int cell, const Vec3d& out) const {
  const PlacedSection& m = middle(cell);
  const Vec3d x = m.centre + radius_ * out;
  if (prism_[static_cast<std::size_t>(cell)]) return x;
  double along = 0;
  for (const int e : {cell, cell + 1}) along += (edge(e).centre - x).dot(edge(e).cut) / m.tangent.dot(edge(e).cut);
  return x + 0.5 * along * m.tangent;
}

}  // namespace onestroke
