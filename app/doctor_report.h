#pragma once

#include <span>
#include <string>
#include <vector>

namespace onestroke {

enum class Health {
  ok,
  lacking,  ///< There, but without something.
  absent,
};

/// One line of what the doctor finds.
struct Finding {
  std::string part{};  ///< "Vulkan": lines of a part stand together.
  Health health = Health::ok;
  std::string what{};
  std::string remedy{};  ///< Or what is lost without it; empty where nothing is wrong.
  bool needed = false;   ///< The demo does not run without.
};

/// Whether the demo runs.
bool can_run(std::span<const Finding> findings);

/// A heading a part, a line a finding, and whether the demo runs.
std::string to_text(std::span<const Finding> findings);
std::string to_json(std::span<const Finding> findings);

/// A finding from an Error's message, "what is wrong: what to do".
Finding finding_of(std::string part, Health health, const std::string& message, bool needed = false);

}  // namespace onestroke
