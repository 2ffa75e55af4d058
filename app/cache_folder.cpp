#include "app/cache_folder.h"

#include <cstdlib>

namespace onestroke {
namespace {

// The XDG rules leave out what is not absolute.
std::filesystem::path named_by(const char* variable) {
  const char* value = std::getenv(variable);
  const std::filesystem::path folder = value ? value : "";
  return folder.is_absolute() ? folder : std::filesystem::path();
}

std::filesystem::path own_folder(const char* variable, const std::filesystem::path& otherwise) {
  if (const auto folder = named_by(variable); !folder.empty()) return folder / "onestroke";
  if (const auto home = named_by("HOME"); !home.empty()) return home / otherwise / "onestroke";
  return {};
}

}  // namespace

std::filesystem::path cache_folder() {
  return own_folder("XDG_CACHE_HOME", ".cache");
}

std::filesystem::path state_folder() {
  return own_folder("XDG_STATE_HOME", ".local/state");
}

std::filesystem::path config_folder() {
  return own_folder("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path assets_folder() {
  const char* named = std::getenv("ONESTROKE_ASSETS");
  return named && *named ? named : ONESTROKE_ASSETS_DIR;
}

}  // namespace onestroke
