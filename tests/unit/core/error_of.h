#pragma once

#include "core/error.h"

#include <functional>
#include <string>

namespace onestroke {

/// What the Error says that `act` throws.
inline std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace onestroke
