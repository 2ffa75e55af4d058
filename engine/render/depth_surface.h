#pragma once

#include "core/pose.h"
#include "render/lens_map.h"

#include <array>
#include <span>

namespace onestroke {

/// A straight piece of something whose depth is known: from one point to the other, camera frame (vision axes), mm.
struct DepthSegment {
  Vec3 from{}, to{};
  /// 1: the surface runs through the segment. 0: it is as if the segment were not there. Between them it is on its way.
  double weight = 1;
  /// The end at which the surface is right to the last, even where it is drawn in cells.
  enum class Pin { none, from, to } pin = Pin::none;
};

/// The segments of a chain of points, written to `segments`; returns how many. Where the chain runs away from the
/// camera or towards it faster than sideways, it is taken to do so as fast as sideways, from the middle point on, which
/// keeps its depth and is pinned: no picture can be bent as sharply as a stick that points at the camera.
std::size_t chain_segments(std::span<const Vec3> points, double weight, std::span<DepthSegment> segments);

/// One axis of the surface's grid. The first cell and the last lie round the picture, the others divide it evenly.
struct SurfaceAxis {
  double outer_from = 0, from = 0, to = 0, outer_to = 0;  ///< In the plane z = 1.
  int cells = 3;

  double step() const { return (to - from) / (cells - 2); }
  /// Where cell i begins; its end is where the next begins.
  double at(int i) const;
  /// The cell with a place in it, and its share of the way through as the fraction; beyond the grid that of its edge.
  double cell_of(double place) const;
};

/// The surface that the camera's picture lies on: depth as a smooth function of the direction from the camera. It runs
/// through the segments, which removes the parallax between camera and eye there, and far from them to a set distance.
/// Between segments 1 / depth is their mean by Shepard's inverse distance weights, distance being that to the segment
/// as the camera sees it; along a segment 1 / depth is then exact, because it is affine in the picture.
class DepthSurface {
 public:
  static constexpr int columns = 48, rows = 36;
  /// More are left out.
  static constexpr std::size_t most_segments = 64;

  /// `inside` is where there is nothing but picture; the surface goes on as far as `around`. The distance is that far
  /// from every segment, mm. Where every direction has the same depth, the picture is one cell, unless it is to be in
  /// cells all the same.
  void build(const PlaneBounds& inside, const PlaneBounds& around, std::span<const DepthSegment> segments,
             double distance, bool in_cells = false);
  /// Whether the picture is more than one.
  bool in_cells() const { return across_.cells == columns; }

  /// 1 / depth at a point of the plane z = 1, 1 / mm, of what was built last.
  double inverse_depth(double x, double y) const { return inverse_depth(x, y, known_); }

  const SurfaceAxis& across() const { return across_; }
  const SurfaceAxis& down() const { return down_; }
  /// At the corners of the cells, rows from the top, left to right; 1 / metres.
  std::span<const float> inverse_depths() const {
    return {values_.data(), static_cast<std::size_t>((across_.cells + 1) * (down_.cells + 1))};
  }

 private:
  /// A segment in the plane z = 1, with 1 / depth at its ends.
  struct Known {
    double x, y, dx, dy, per_length2, q, dq;
  };

  double inverse_depth(double x, double y, std::size_t known) const;
  void fill();
  void pin(double x, double y, double q);
  void add(const DepthSegment& segment, std::size_t settled);

  SurfaceAxis across_, down_;
  double far_ = 0;  // 1 / distance
  std::array<Known, most_segments> segments_{};
  std::size_t known_ = 0;
  std::array<float, std::size_t{columns + 1} * (rows + 1)> values_{};
};

}  // namespace onestroke
