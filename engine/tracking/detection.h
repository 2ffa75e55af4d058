#pragma once

#include "tracking/appearance.h"
#include "tracking/refine.h"

#include <vector>

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

/// A picture as taken and smoothed against noise, twice.
struct Levels {
  ImageView sharp, soft, softer;

  /// The one to measure a rod in: where a cell spans many pixels a smoothed picture loses nothing but noise.
  const ImageView& for_pitch(double pixels) const { return pixels > 14 ? softer : pixels > 10 ? soft : sharp; }
};

/// Memory for the levels of one picture after another.
class LevelMaker {
 public:
  /// The levels borrow the picture and this object's memory.
  Levels make(const ImageView& picture);

 private:
  std::vector<std::uint8_t> soft_, softer_;
};

}  // namespace onestroke
