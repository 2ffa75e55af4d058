#pragma once

#include <string>

namespace onestroke {

/// A line on standard error, with the program's name before it.
void say(const std::string& line);

}  // namespace onestroke
