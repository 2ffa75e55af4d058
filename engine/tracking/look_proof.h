#pragma once

#include "tracking/detection.h"
#include "tracking/levels.h"

namespace onestroke {

/// From which poses the look is fitted: the expected one, or where that leads to what is likely but not proven, also
/// ones tilted a little, which takes up to nine times as long.
enum class LookStarts { expected, tilted_too };

/// Finds a marker near where it is expected by its whole look, where lines along its rod prove nothing: an arm that
/// points at the camera, or one of which little is uncovered. Takes as long as some hundred line proofs. Where an arm
/// is hidden behind the other, the roll about that one is taken as expected: that nothing is seen of an arm tells it to
/// within a rod's thickness. False where the rod does not show there, and where the fit ends further off than a
/// prediction errs: it would be another way of holding the rod. `marker` is the rod's place in the catalogue.
bool prove_by_look(const Levels& levels, const Intrinsics& intrinsics, int marker, const RodModel& rod,
                   const EigenPose& expected, const Inks& inks, Detection& detection, LookStarts starts);

/// Whether the whole look proves the pose that a detection has, by its inks; its appearance and likelihood are filled
/// in. A small part of what prove_by_look() costs. Where an arm shows nothing, which may be covered, the roll about the
/// other one is that of the pose: it must have been expected, with this standard deviation of a turn, and so certainly
/// that the arm's end would not be a rod's thickness off.
bool shows_look(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, double turn_sigma,
                Detection& detection);

}  // namespace onestroke
