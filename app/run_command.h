#pragma once

#include "app/command_line.h"

#include <iosfwd>

namespace onestroke {

/// `onestroke run`: returns the exit code when the show is over. What the display has to show for it (files) goes to
/// `out`, a line each. Throws Error where it cannot start or go on.
int run_command(const RunOptions& options, std::ostream& out);

}  // namespace onestroke
