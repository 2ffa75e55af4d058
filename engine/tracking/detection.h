#pragma once

#include "tracking/appearance.h"
#include "tracking/refine.h"

namespace onestroke {

/// One marker found in one picture.
struct Detection {
  int marker = 0;  ///< Index into the catalogue.
  Refinement refinement;
  Appearance appearance;
  Inks inks;
  double likelihood = 0;  ///< PhotometricFit's, where its whole look proved it.
  /// What was expected of the pose is counted in: where the picture tells nothing of it, it is that.
  bool as_expected = false;
  /// Where the shutter rolls, how it moves: see Motion; and the covariance of both, angular first.
  bool moving = false;
  Vec3d angular = Vec3d::Zero(), linear = Vec3d::Zero();
  Matrix6d velocity_covariance = Matrix6d::Zero();
};

/// Where a marker may be, not proven yet.
struct PoseCandidate {
  int marker;  ///< Index into the catalogue.
  EigenPose pose;
  Inks inks;
  double evidence;    ///< Appearance's.
  double likelihood;  ///< LikelihoodMeter's.
};

}  // namespace onestroke
