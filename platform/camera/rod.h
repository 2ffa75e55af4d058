#pragma once

#include "marker/catalog.h"

#include <array>
#include <vector>

namespace onestroke {

/// A ball of the marker frame, mm.
struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// A marker's rod as a ray meets it: round pieces cut by planes, mitred where the centreline has a corner; an arc is a
/// chain of short ones with the torus's own normals. Marker frame, millimetres.
class Rod {
 public:
  /// A cylinder between two planes; the inside of plane i is dot(normal, p) <= offset.
  struct Part {
    Vec3 origin, axis;
    std::array<Vec3, 2> normal;
    std::array<double, 2> offset;
    std::size_t piece = 0;
  };
  /// The parts of one piece of the centreline, and balls that cover them.
  struct Group {
    std::size_t first = 0, last = 0;
    std::vector<Ball> cover;
  };
  /// Where a surface point lies: its outward unit normal, arc length and cell.
  struct Surface {
    Vec3 normal;
    double s = 0;
    int cell = 0;
  };

  explicit Rod(const MarkerSpec& spec);

  const MarkerSpec& spec() const { return spec_; }
  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Group>& groups() const { return groups_; }
  double radius() const { return spec_.shape.radius(); }
  /// cap: the plane of the part that was hit, or -1 for its side.
  Surface surface(const Part& part, int cap, Vec3 point) const;
  /// The middle of the rod's extent, about which it turns most compactly.
  Vec3 centre() const;

 private:
  void add_piece(std::size_t index);
  Vec3 cut(double s) const;

  MarkerSpec spec_;
  std::vector<Part> parts_;
  std::vector<Group> groups_;
};

/// A rod seen from one point: what of the ray equations does not depend on the ray's direction.
class PlacedRod {
 public:
  struct Hit {
    double t = 0;
    std::size_t part = 0;
    int cap = -1;
  };

  /// The rod must outlive its use here.
  void hold(const Rod& rod);
  /// Marker frame position of the point that the rays start at.
  void look_from(Vec3 eye);
  /// The nearest hit nearer than limit along eye + t * direction, among the parts of one group.
  bool cast(std::size_t group, Vec3 direction, double limit, Hit& hit) const;

  const Rod& rod() const { return *rod_; }
  Vec3 eye() const { return eye_; }

 private:
  struct Start {
    Vec3 across;   ///< Eye's offset from the axis, at right angles to it.
    double c = 0;  ///< |across|^2 - radius^2
    std::array<double, 2> room{};
  };

  const Rod* rod_ = nullptr;
  Vec3 eye_;
  std::vector<Start> starts_;
};

}  // namespace onestroke
