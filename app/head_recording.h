#pragma once

#include "app/command_line.h"
#include "app/head_sights.h"

#include <string>

namespace onestroke {

/// What a calibration is made from, and what is known of where it comes from.
struct HeadRecording {
  HeadSights sights;
  std::string headset{}, camera{};
  double focal_px = 0;
};

/// A session's log, which has the poses of the head's camera and of the markers. Throws Error.
HeadRecording record_from_log(const CalibrateOptions& options);
/// Pictures, and a file of where the head was. Throws Error.
HeadRecording record_from_poses(const CalibrateOptions& options);
/// The wearer, who is told in the headset what to do, until there is enough, or the time is over. Throws Error.
HeadRecording record_live(const CalibrateOptions& options);

}  // namespace onestroke
