#pragma once

#include "core/frame_record.h"
#include "core/picture.h"
#include "marker/catalog.h"

#include <functional>
#include <string>
#include <vector>

namespace onestroke::accuracy {

/// What two eyes' cameras see of one stick at many orientations, 300 to 600 mm away, before a room.
enum class StereoScene {
  any_orientation,
  pointing,  ///< One arm points at the left camera, which then sees little but its tip.
  covered,   ///< A finger covers an arm and more, for the left camera alone.
};

/// A pair of pictures, the first with its second, and the truth in the first camera's frame; borrowed during the call.
using VisitPair = std::function<void(const Picture& pair, int id, const Pose& T_camera_marker)>;

/// 960 x 720 at 50 degrees, 64 mm apart and turned a little to each other, with mild noise and blur. The same pictures
/// every time.
void draw_pairs(StereoScene scene, int orientations, const VisitPair& visit);

/// How well one pose after another was told.
struct StereoScore {
  int pictures = 0, measured = 0, wrong = 0;
  std::vector<double> rotation_deg, position_mm;  ///< Of the stick's middle; of those measured and not wrong.
  std::vector<double> nees;                       ///< Squared Mahalanobis distance from the truth; 6 is right.

  /// Wrong is what is 10 degrees or 5 % of the distance off.
  void add(const FrameRecord& record, int id, const Pose& T_camera_marker);
};

/// The left camera's tracker alone, the right one's, and both together; each pair of pictures for itself.
struct StereoScores {
  StereoScore left, right, both;
};
StereoScores measure_pairs(StereoScene scene, int orientations = 60);

}  // namespace onestroke::accuracy
