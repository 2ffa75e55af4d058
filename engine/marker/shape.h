#pragma once

#include "core/pose.h"

#include <string>
#include <vector>

namespace onestroke {

/// A point of a centreline and the unit direction of travel there.
struct CentrelinePoint {
  Vec3 position;
  Vec3 tangent;
};

/// What a marker's rod looks like: a round rod along a one-stroke centreline, cut into rings of equal arc length.
/// Marker frame, millimetres. Arc length s runs from 0 (start tip, red) to length() (stop tip).
///
/// `angle`: origin where the straight axes meet, start arm along -y, stop arm along +x; with a bend radius r_b the
/// corner is a fillet of that radius, and the arc is centred on the boundary between the two middle cells.
/// `stroke`: straight pieces between vertices, each inner corner a fillet of bend_radius (0 for a mitre).
/// `line`: straight along +x, centred on the origin; it has no roll about its axis.
class Shape {
 public:
  enum class Kind { angle, stroke, line };

  /// A piece of the centreline: straight where radius is 0, otherwise an arc about centre.
  struct Piece {
    double start = 0, length = 0;  ///< Arc length, mm.
    Vec3 origin;                   ///< Its first point.
    Vec3 tangent;                  ///< Direction at its first point.
    Vec3 normal;                   ///< Arcs: unit vector from the first point to the arc's centre.
    double radius = 0;
  };

  /// Each throws Error where the numbers make no rod: cells outside 3..64 (an odd number for an angle), a pitch outside
  /// (0, 1000] mm, a radius below a hundredth of it, a negative bend (0 is a mitre), a bend that does not fit, a stroke
  /// that overlaps itself, or vertices whose length is not cells * pitch to 0.01 mm.
  static Shape angle(int cells, double pitch, double radius, double bend_radius);
  static Shape stroke(int cells, double pitch, double radius, double bend_radius, std::vector<Vec3> vertices);
  static Shape line(int cells, double pitch, double radius);

  Kind kind() const { return kind_; }
  int cells() const { return cells_; }
  double pitch() const { return pitch_; }
  double radius() const { return radius_; }
  double bend_radius() const { return bend_radius_; }
  /// Of every kind: the corners of the straight axes, from tip to tip.
  const std::vector<Vec3>& vertices() const { return vertices_; }
  double length() const { return cells_ * pitch_; }

  const std::vector<Piece>& pieces() const { return pieces_; }
  /// s is clamped to [0, length()]. At a mitre the tangent is that of the piece that follows.
  CentrelinePoint at(double s) const;
  /// Direction in which the ring edge at arc length s is cut: the unit normal of its plane. At a mitre between pieces
  /// this is the bisector of the two tangents; elsewhere the tangent.
  Vec3 cut_normal(double s) const;
  /// Roll about the axis can be told from the picture: false for a straight line.
  bool has_roll() const;

 private:
  Shape() = default;
  Kind kind_ = Kind::angle;
  int cells_ = 0;
  double pitch_ = 0, radius_ = 0, bend_radius_ = 0;
  std::vector<Vec3> vertices_;
  std::vector<Piece> pieces_;
};

}  // namespace onestroke
