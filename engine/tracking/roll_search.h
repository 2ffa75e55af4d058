#pragma once

#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/rod_model.h"

#include <vector>

namespace onestroke {

struct RollCandidate {
  EigenPose pose;
  double evidence;  ///< Appearance::evidence() of the whole rod.
};

/// The pose of one straight arm is known but for the roll about it: turns the rod about that arm all the way round and
/// returns the rolls under which the picture shows the other cells best, best first, `count` at most.
std::vector<RollCandidate> search_roll(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod,
                                       const Inks& inks, const EigenPose& pose, int cell_on_arm, int count);

/// Tilts an arm towards or away from the camera by an angle, its image staying about where and as long as it is.
EigenPose tilt_arm(const RodModel& rod, const EigenPose& pose, int cell_on_arm, double angle);

}  // namespace onestroke
