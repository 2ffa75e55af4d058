#pragma once

#include "app/command_line.h"
#include "marker/catalog.h"

#include <iosfwd>
#include <string>

namespace onestroke {

/// `onestroke marker`: returns the exit code. Throws Error where it fails, and then nothing has been changed.
int marker_command(const MarkerOptions& options, std::ostream& out);

/// The table of `marker list`.
std::string describe(const Catalog& catalog);
/// All about one marker, as `marker show` prints it.
std::string describe(const MarkerSpec& marker);
/// The cells as letters where they lie on the rod, one line and two columns a pitch, seen along the marker's flattest
/// axis.
std::string letter_picture(const MarkerSpec& marker);

}  // namespace onestroke
