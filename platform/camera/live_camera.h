#pragma once

#include "camera/capture.h"
#include "camera/lens_source.h"
#include "core/camera.h"

#include <memory>

namespace onestroke {

/// A device as a Camera. It may go away, fall silent or be another program's: next() then says `busy` and trouble()
/// why, and pictures come again as soon as it is there again. Pictures of a format that the tracker and the GPU read
/// are lent out of the device's own memory where it has enough of it; others are decoded, or copied, once. Where more
/// pictures wait than two, the newest are given.
///
/// Starts the device; throws Error where it is not there or will never do, so that a wrong name is found out at once,
/// but not where another program has it.
std::unique_ptr<Camera> make_live_camera(std::unique_ptr<CaptureSource> source, const LensSource& lens,
                                         Duration readout, const LiveOptions& options);

}  // namespace onestroke
