#pragma once

#include "core/frame_record.h"

namespace onestroke {

/// Takes what was found in the second picture of a pair into the record of the first, whose camera, axes and time the
/// poses are of from then on. Allocates nothing.
///
/// A marker that both pictures show has the pose that both together tell: see fused(). The second's is carried over the
/// time between the exposures by its velocity, and over the cameras' places by T_world_camera of both, which brings in
/// the head's motion in between. Where the two differ by more than their covariances allow, that of both together is as
/// much larger as makes the difference a usual one (Birge, "The Calculation of Errors by the Method of Least Squares",
/// Physical Review 40, 1932). Two poses so far apart that they are of two ideas of the marker are not mixed: of those
/// that which is the surer by its covariance counts. It need not be the right one, and its covariance does not say so.
/// The same holds where both together would be far from both, as of a stick of which either eye shows one arm: neither
/// tells the roll, and the little by which they differ otherwise would decide it. Of states the better one counts,
/// measured before predicted before lost, and with it its pose. Cells and their centres stay those of the first
/// picture; second_cells says which the second one shows.
void fuse_second(const FrameRecord& second, FrameRecord& record);

}  // namespace onestroke
