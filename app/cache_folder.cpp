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

}  // namespace

std::filesystem::path cache_folder() {
  if (const auto folder = named_by("XDG_CACHE_HOME"); !folder.empty()) return folder / "onestroke";
  if (const auto home = named_by("HOME"); !home.empty()) return home / ".cache" / "onestroke";
  return {};
}

}  // namespace onestroke
