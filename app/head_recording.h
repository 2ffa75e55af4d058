#pragma once

#include "app/command_line.h"
#include "app/sights.h"

#include <string>

namespace onestroke {

/// Where a calibration's sights come from.
struct HeadRecording {
  std::string headset{}, camera{};
  double focal_px = 0;
};

/// A session's log, which has the poses of the head's camera and of the markers. Throws Error.
HeadRecording record_from_log(const CalibrateOptions& options, Sights& sights);
/// Pictures, and a file of where the head was; without one, pictures that say so themselves. Throws Error.
HeadRecording record_from_poses(const CalibrateOptions& options, Sights& sights);
/// The wearer, who is told in the headset what to do, until there is enough, or the time is over. Throws Error.
HeadRecording record_live(const CalibrateOptions& options, Sights& sights);
/// The one of these that the options ask for.
HeadRecording record_sights(const CalibrateOptions& options, Sights& sights);

}  // namespace onestroke
