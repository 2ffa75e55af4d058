#pragma once

#include "app/command_line.h"

#include <iosfwd>

namespace onestroke {

/// `onestroke doctor`: what there is, and what each part lacks. Returns 0 where the demo can run, otherwise 1. Throws
/// Error where standard output cannot be written, and for nothing else.
int doctor_command(const DoctorOptions& options, std::ostream& out);

}  // namespace onestroke
