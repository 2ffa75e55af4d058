#pragma once

#include "app/command_line.h"

#include <iosfwd>

namespace onestroke {

/// `onestroke calibrate head`: how the headset carries its camera, from a marker that lies still and a head that moves;
/// `onestroke calibrate camera --clock`: how much later than its time says a picture was exposed, from the same.
/// Returns the exit code. Throws Error.
int calibrate_command(const CalibrateOptions& options, std::ostream& out);

}  // namespace onestroke
