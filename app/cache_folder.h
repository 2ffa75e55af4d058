#pragma once

#include <filesystem>

namespace onestroke {

/// Where the program keeps what it can make again: $XDG_CACHE_HOME/onestroke, else ~/.cache/onestroke. Empty where the
/// environment names no such place; it need not be there.
std::filesystem::path cache_folder();
/// Where it keeps what it has done, by the same rules: $XDG_STATE_HOME/onestroke, else ~/.local/state/onestroke.
std::filesystem::path state_folder();
/// Where it keeps what the user has settled: $XDG_CONFIG_HOME/onestroke, else ~/.config/onestroke.
std::filesystem::path config_folder();
/// What the program comes with: the folder that ONESTROKE_ASSETS names, else the one it was built from.
std::filesystem::path assets_folder();

}  // namespace onestroke
