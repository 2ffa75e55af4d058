#include "guest_run.h"

#include "fingerprint.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace onestroke {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::vector<nlohmann::json> read_lines(const std::filesystem::path& file) {
  std::vector<nlohmann::json> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

std::uint64_t fingerprint_of_file(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  return fingerprint({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::vector<nlohmann::json> GuestRun::events_of(const std::string& name) const {
  std::vector<nlohmann::json> some;
  std::ranges::copy_if(events, std::back_inserter(some), [&](const auto& e) { return e["event"] == name; });
  return some;
}

std::size_t GuestRun::times_said(const std::string& words) const {
  return static_cast<std::size_t>(std::ranges::count_if(said, [&](const auto& line) {
    return line.contains("said") && line["said"].template get<std::string>().find(words) != std::string::npos;
  }));
}

Time GuestRun::on_this_machine(Time in_guest) const {
  const auto number = [this](std::size_t i, const char* name) { return clock.at(i).at(name).get<double>(); };
  // The two clocks differ a little in speed.
  const double along =
      (static_cast<double>(in_guest.ns) - number(0, "at_ns")) / (number(1, "at_ns") - number(0, "at_ns"));
  const double lead = number(0, "lead_ns") + along * (number(1, "lead_ns") - number(0, "lead_ns"));
  return in_guest + Duration{static_cast<std::int64_t>(lead)};
}

GuestRun run_in_guest(const std::string& name, const std::string& camera, const std::string& program) {
  const std::filesystem::path logs = std::filesystem::path(CAMERA_LOGS) / name;
  std::filesystem::create_directories(logs);
  const std::string command = WITH_CAMERA " " CAMERA_GUEST " " + logs.string() + " " USB_CAMERA " " + camera + " -- " +
                              program + " >" + (logs / "said.log").string() + " 2>&1";
  const int status = std::system(command.c_str());
  GuestRun run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.output = read_text(logs / "said.log");
  run.results = logs / "results";
  run.events = read_lines(logs / "camera.jsonl");
  run.pictures = read_lines(run.results / "pictures.jsonl");
  run.said = read_lines(run.results / "said.jsonl");
  run.clock = read_lines(run.results / "clock.jsonl");
  const std::vector<nlohmann::json> end = read_lines(run.results / "end.json");
  if (!end.empty()) run.end = end.front();
  return run;
}

}  // namespace onestroke
