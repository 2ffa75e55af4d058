#pragma once

#include "marker/catalog.h"
#include "tracking/camera_model.h"

#include <vector>

namespace onestroke {

/// A marker's rod prepared for the solvers: marker frame, millimetres.
class RodModel {
 public:
  /// A cross-section of the rod: a ring edge or the middle of a cell.
  struct Section {
    double s = 0;  ///< Arc length.
    Vec3d centre;
    Vec3d tangent;
    Vec3d cut;  ///< Normal of the plane of the section: the tangent, but at a mitre.
  };

  explicit RodModel(const MarkerSpec& spec);

  int cell_count() const { return static_cast<int>(inks_.size()); }
  int ink(int cell) const { return inks_[static_cast<std::size_t>(cell)]; }
  double radius() const { return radius_; }
  double pitch() const { return pitch_; }
  double length() const { return pitch_ * cell_count(); }
  /// Middle of a cell.
  const Section& middle(int cell) const { return middles_[static_cast<std::size_t>(cell)]; }
  /// Ring edge between cell edge - 1 and cell edge; 0 and cell_count() are the tips.
  const Section& edge(int edge) const { return edges_[static_cast<std::size_t>(edge)]; }
  Section section_at(double s) const;
  const Shape& shape() const { return shape_; }

  /// The straight piece a cell's middle lies on, counted from the start; -1 in a bend.
  int arm_of(int cell) const { return arms_[static_cast<std::size_t>(cell)]; }
  /// Where the straight axes of arm and arm + 1 meet: the arc length at which each, prolonged, would reach that point.
  /// The two differ by the bend.
  struct Meeting {
    double on_arm, on_next;
  };
  const Meeting& meeting(int arm) const { return meetings_[static_cast<std::size_t>(arm)]; }
  bool has_roll() const { return has_roll_; }
  /// Middle of the bounding sphere and its radius.
  Vec3d centre() const { return centre_; }
  double bounding_radius() const { return bounding_radius_; }
  /// Normal of the plane nearest to the centreline.
  const Vec3d& plane_normal() const { return plane_normal_; }

  /// The surface point of a section at the angle phi about the rod from the side that faces the eye; and its normal.
  Vec3d surface(const Section& section, const Vec3d& eye, double phi, Vec3d* normal = nullptr) const;
  /// The rod itself stands between the surface point of a section, which faces the eye, and the eye.
  bool hides_itself(const Section& section, const Vec3d& point, const Vec3d& eye) const {
    return hides_within(section, point, eye, 0.95 * radius_);
  }
  /// No point of a section's rim is hidden by the rod itself: one test for all of them.
  bool shows_whole(const Section& section, const Vec3d& eye) const {
    return !hides_within(section, section.centre, eye, 2.1 * radius_);
  }

 private:
  bool hides_within(const Section& section, const Vec3d& point, const Vec3d& eye, double reach) const;
  void find_arms(const std::vector<Shape::Piece>& pieces);

  double radius_, pitch_;
  std::vector<int> inks_, arms_;
  std::vector<Section> middles_, edges_;
  Shape shape_;
  bool has_roll_;
  Vec3d centre_;
  double bounding_radius_ = 0;
  Vec3d plane_normal_;
  // Straight chords of the centreline with their arc lengths, for the visibility test.
  struct Chord {
    Vec3d a, b;
    double s0, s1;
    bool straight;
  };
  std::vector<Chord> chords_;
  std::vector<Meeting> meetings_;
};

/// Pixels that one cell pitch spans where the marker is, foreshortening aside: the yardstick for errors in the picture.
double pitch_in_pixels(const Intrinsics& k, const RodModel& rod, const EigenPose& pose);

}  // namespace onestroke
