#pragma once

#include "tracking/detection.h"
#include "tracking/line_fit.h"

namespace onestroke {

/// Puts the pose of a detection right by all that its ring edges and its outline tell, and finds its velocity where the
/// shutter rolls. Leaves it as it is where cells are too small, too blurred or too few for lines to tell more. Used by
/// one thread at a time.
class Sharpener {
 public:
  /// False where it leaves the detection as it is.
  bool sharpen(const TimedView& view, const RodModel& rod, Detection& detection);

 private:
  LineFitter fitter_;
};

}  // namespace onestroke
