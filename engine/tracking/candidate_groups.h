#pragma once

#include "tracking/detection.h"
#include "tracking/rod_model.h"

#include <vector>

namespace onestroke {

/// One marker's candidates by where they stand: those of a group differ in how the rod is held, not in where. Groups
/// and what is in them stand in the order of the candidates. A speckled background reads as a marker far away here and
/// there, which must not stand in for the true place: candidates are comparable before the same surroundings only.
std::vector<std::vector<PoseCandidate>> group_by_place(const RodModel& rod,
                                                       const std::vector<PoseCandidate>& candidates);

}  // namespace onestroke
