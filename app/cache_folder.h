#pragma once

#include <filesystem>

namespace onestroke {

/// Where the program keeps what it can make again: $XDG_CACHE_HOME/onestroke, else ~/.cache/onestroke. Empty where the
/// environment names no such place; it need not be there.
std::filesystem::path cache_folder();

}  // namespace onestroke
