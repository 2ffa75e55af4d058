#pragma once

#include "tracking/rod_model.h"

#include <vector>

namespace onestroke {

/// Rays against the rod's exact surface: round pieces cut by the planes in which they meet, and the end discs. A bend
/// is taken as six straight pieces. Marker frame, millimetres.
class RodCaster {
 public:
  explicit RodCaster(const RodModel& rod);

  struct Hit {
    bool hit = false;
    double s = 0;      ///< Arc length of the surface point, or of the point nearest to a ray that misses.
    Vec3d point;       ///< On the ray.
    double gap = 1e9;  ///< How far beyond the surface the ray passes; 0 where it hits.
  };
  /// The first surface point along eye + lambda * direction, lambda > 0.
  Hit cast(const Vec3d& eye, const Vec3d& direction) const;

 private:
  struct Piece {
    Vec3d a, b, axis;
    Vec3d cut_a, cut_b;  // Normals of the planes that end it, along the travel.
    double s0, length;
    bool first, last;
  };
  std::vector<Piece> pieces_;
  double radius_;
};

}  // namespace onestroke
