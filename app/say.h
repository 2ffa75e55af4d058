#pragma once

#include <iosfwd>
#include <string>

namespace onestroke {

/// A line on standard error, with the program's name before it.
void say(const std::string& line);
/// Ends what a command writes to standard output. Throws Error where that cannot be written.
void end_output(std::ostream& out);

}  // namespace onestroke
