#pragma once

#include <stdexcept>
#include <string>

namespace onestroke {

/// Something at start-up or in a command that cannot go on. The message names the thing and the remedy, in one line,
/// for the person at the terminal. The frame loop never throws it; it uses status values.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

/// The command line itself is wrong: the program ends with exit code 2 instead of 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace onestroke
