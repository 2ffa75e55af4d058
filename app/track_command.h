#pragma once

#include "app/command_line.h"

#include <iosfwd>

namespace onestroke {

/// `onestroke track`: returns the exit code. Lines go to options.output, or to `out` where there is none, each as soon
/// as its picture is done and in the pictures' order. Throws Error where it cannot go on; what was written stays.
int track_command(const TrackOptions& options, std::ostream& out);

}  // namespace onestroke
