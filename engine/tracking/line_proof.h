#pragma once

#include "tracking/detection.h"
#include "tracking/line_fit.h"

namespace onestroke {

/// Cells that must show their ink for a marker to be believed.
inline constexpr int min_agreeing = 9;

/// Whether a refined pose is believed: enough cells of the right inks, few of a wrong one, both arms seen, ring edges
/// where they should be.
bool believable(const RodModel& rod, const Refinement& refinement, const Appearance& appearance);

/// How near to what is expected a marker is looked for: within ten pixels, half a dozen, one or two, or as good as
/// there.
enum class Nearness { roughly, loosely, nearly, exactly };

/// Finds a marker near where it is expected by a few lines along its rod, at a small part of what a search costs. Used
/// by one thread at a time.
class LineProof {
 public:
  /// False where its ring edges do not show there; the detection then tells what they led to, its refinement not valid
  /// where that is nothing. `marker` is the rod's place in the catalogue.
  bool prove(const TimedView& view, int marker, const RodModel& rod, const Motion& expected, const MotionPrior& prior,
             const Inks& inks, Detection& detection, Nearness nearness = Nearness::roughly);

  /// Measures the pose of a detection by all that its ring edges, its outline and what else is known tell together.
  /// Says nothing of whether it is the marker's. False where the edges do not agree, which leaves it as it is.
  bool measure(const TimedView& view, const RodModel& rod, const Motion& start, const MotionPrior& known,
               Detection& detection);

 private:
  LineFitter fitter_;
};

}  // namespace onestroke
