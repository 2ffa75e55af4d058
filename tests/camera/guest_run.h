#pragma once

#include "core/time.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace onestroke {

/// What a program in the guest and the camera beside it left behind.
struct GuestRun {
  int code = -1;         ///< The program's, or one of with_camera's.
  std::string output{};  ///< What the program said.
  std::filesystem::path results{};
  std::vector<nlohmann::json> events{};    ///< The camera's log: see event_log.h.
  std::vector<nlohmann::json> pictures{};  ///< Here and below: see take_pictures.cpp.
  std::vector<nlohmann::json> said{};
  std::vector<nlohmann::json> clock{};
  nlohmann::json end{};

  std::vector<nlohmann::json> events_of(const std::string& name) const;
  /// How often the camera said a line with these words.
  std::size_t times_said(const std::string& words) const;
  /// A time of the guest's on this machine's clock. Throws where the guest did not ask for it twice.
  Time on_this_machine(Time in_guest) const;
};

/// Plays the camera with these options to a program in the guest. Both are parts of a shell's command line. `name` is
/// of the folder that keeps what is left.
GuestRun run_in_guest(const std::string& name, const std::string& camera, const std::string& program);

/// A line of JSON each; none where the file is not there.
std::vector<nlohmann::json> read_lines(const std::filesystem::path& file);

/// Of one of the played pictures.
std::uint64_t fingerprint_of_file(const std::filesystem::path& file);

}  // namespace onestroke
