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
