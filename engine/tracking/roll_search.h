#pragma once

#include "tracking/likelihood.h"

#include <vector>

namespace onestroke {

struct RollCandidate {
  EigenPose pose;
  double likelihood;  ///< LikelihoodMeter's, of the whole rod.
};

/// The pose of one straight arm is known but for the roll about it: turns the rod about that arm all the way round and
/// returns the rolls under which the picture shows the whole rod best, best first, `count` at most.
std::vector<RollCandidate> search_roll(const LikelihoodMeter& meter, const EigenPose& pose, int cell_on_arm, int count);

/// By how much a pose is likelier than the likeliest of those that turn the rod about one of its straight arms to
/// another place: small where the other arm is covered, so that its direction is anybody's guess.
double roll_margin(const LikelihoodMeter& meter, const EigenPose& pose);

/// The other tilt under which the rod, if flat, looks much the same from afar: its image in the plane through its
/// middle that the line of sight meets at right angles.
EigenPose mirrored(const RodModel& rod, const EigenPose& pose);

/// One cell in the middle of each straight arm.
std::vector<int> arm_middles(const RodModel& rod);

/// Climbs from a pose to a likelier one nearby by turning and tilting either arm, the other standing still in the
/// picture: in steps of 4, 2 and 1 degrees.
RollCandidate climb(const LikelihoodMeter& meter, const EigenPose& start);

/// Turns the rod by an angle about the axis of the arm that a cell lies on.
EigenPose roll_about(const RodModel& rod, const EigenPose& pose, int cell_on_arm, double angle);

/// Tilts an arm towards or away from the camera by an angle, its image staying about where and as long as it is.
EigenPose tilt_arm(const RodModel& rod, const EigenPose& pose, int cell_on_arm, double angle);

}  // namespace onestroke
