#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace onestroke {

/// A to Z as a to z; all other bytes as they are.
inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace onestroke
