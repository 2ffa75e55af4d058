#pragma once

#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/rod_model.h"

#include <vector>

namespace onestroke {

/// One edge point of the rod found in the picture: the model point, the unit normal of the edge in the picture, and how
/// far along it from the prediction the edge was found.
struct EdgeMeasurement {
  Vec3d point;   ///< Camera axes, mm, at the pose it was predicted from.
  Vec2d normal;  ///< Unit, pixels.
  double offset = 0;
  bool ring = true;  ///< Ring edge, or else the rod's outline.
  int cell = 0;      ///< The cell after the ring edge, or beside the outline.
};

struct EdgeSet {
  std::vector<EdgeMeasurement> edges;
  int expected_rings = 0;  ///< Ring-edge points that the pose says are in sight.
};

struct CellRange {
  int first, last;  ///< Both included.
};

/// Predicts every edge point in sight under a pose and looks for it in the picture.
void measure_edges(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                   const EigenPose& pose, CellRange range, EdgeSet& set);

}  // namespace onestroke
