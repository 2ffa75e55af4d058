#pragma once

#include <ctime>
#include <filesystem>

namespace onestroke {

/// The name of a new log in a folder of sessions: DATE-TIME.jsonl, local time, or one beside it where that is taken.
/// Makes the folder where it is missing, and removes the oldest logs so that there are at most `kept` with the new one.
/// Throws Error where the folder cannot be made.
std::filesystem::path new_session_file(const std::filesystem::path& folder, std::time_t when, std::size_t kept = 10);

}  // namespace onestroke
