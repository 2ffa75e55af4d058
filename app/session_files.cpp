#include "app/session_files.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* ending = ".jsonl";
constexpr const char* date_and_time = "%Y-%m-%d-%H%M%S";
constexpr std::size_t date_and_time_length = 17;

std::string named(std::time_t when) {
  std::tm local{};
  localtime_r(&when, &local);
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), date_and_time, &local)};
}

/// What a person put there under another name is left alone.
bool is_session(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ending && stem.size() >= date_and_time_length &&
         stem.find_first_not_of("0123456789-") == std::string::npos;
}

void remove_oldest(const fs::path& folder, std::size_t kept) {
  std::error_code failed;
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
    if (is_session(at->path())) files.push_back(at->path());
  std::ranges::sort(files);
  for (std::size_t i = 0; i + kept < files.size(); ++i) fs::remove(files[i], failed);
}

}  // namespace

fs::path new_session_file(const fs::path& folder, std::time_t when, std::size_t kept) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || !fs::is_directory(folder, failed))
    throw Error("folder " + folder.string() + " cannot be made; check that you may write there");
  remove_oldest(folder, kept - 1);
  const std::string name = named(when);
  fs::path file = folder / (name + ending);
  for (int other = 2; fs::exists(file, failed); ++other) file = folder / (name + "-" + std::to_string(other) + ending);
  return file;
}

}  // namespace onestroke
