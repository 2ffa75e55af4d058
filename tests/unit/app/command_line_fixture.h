#pragma once

#include "app/command_line.h"
#include "core/error.h"

#include <iterator>
#include <sstream>
#include <string>
#include <variant>

namespace onestroke {

/// The arguments as a shell would part them; no quoting.
inline Command parse(const std::string& line) {
  std::istringstream words(line);
  return parse_command_line({std::istream_iterator<std::string>(words), {}});
}

template <typename Options>
Options parsed(const std::string& line) {
  return std::get<Options>(parse(line));
}

inline std::string printed(const std::string& line) {
  return parsed<PrintText>(line).text;
}

inline std::string refusal(const std::string& line) {
  try {
    parse(line);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace onestroke
