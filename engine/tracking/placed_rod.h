#pragma once

#include "tracking/rod_model.h"

#include <array>

namespace onestroke {

/// A cross-section of a rod in camera axes, where the eye is the origin.
struct PlacedSection {
  Vec3d centre, tangent, cut;
  Vec3d front, side;  ///< Of the directions square to the tangent, the one that faces the eye, and the other.
  double along;       ///< Of the tangent along the cut's normal.
  bool square;        ///< The cut is square to the tangent, as everywhere but at a mitre.

  /// A direction square to the tangent, by its angle from the front.
  Vec3d out(double sine, double cosine) const { return cosine * front + sine * side; }
  /// The point of the cut that lies in such a direction on the rod's surface.
  Vec3d surface(double radius, const Vec3d& out) const {
    const Vec3d x = centre + radius * out;
    return square ? x : Vec3d(x - (radius * out.dot(cut) / along) * tangent);
  }
};

/// All sections of a rod at a pose, computed once for all that is measured there.
class PlacedRod {
 public:
  PlacedRod(const RodModel& rod, const EigenPose& pose);

  const PlacedSection& middle(int cell) const { return middles_[static_cast<std::size_t>(cell)]; }
  const PlacedSection& edge(int edge) const { return edges_[static_cast<std::size_t>(edge)]; }
  /// The middle of a cell on the generator line in a direction `out` of its middle section: halfway between the planes
  /// that cut it, which lean at a mitre.
  Vec3d middle_of(int cell, const Vec3d& out) const;

 private:
  double radius_;
  std::array<PlacedSection, max_cells> middles_;
  std::array<PlacedSection, max_cells + 1> edges_;
  std::array<bool, max_cells> prism_;  // Both cuts of a cell are square to its axis.
};

}  // namespace onestroke
