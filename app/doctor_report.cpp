#include "app/doctor_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace onestroke {
namespace {

const char* word_of(Health health) {
  switch (health) {
    case Health::ok:
      return "ok";
    case Health::lacking:
      return "lacking";
    default:
      return "absent";
  }
}

bool stands_in_the_way(const Finding& finding) {
  return finding.needed && finding.health != Health::ok;
}

/// From the width of "lacking  " on.
std::string line_of(const Finding& finding) {
  std::string line = "  " + std::string(word_of(finding.health));
  line.resize(11, ' ');
  line += finding.what;
  if (!finding.remedy.empty()) line += ": " + finding.remedy;
  return line + "\n";
}

}  // namespace

bool can_run(std::span<const Finding> findings) {
  return std::ranges::none_of(findings, stands_in_the_way);
}

std::string to_text(std::span<const Finding> findings) {
  std::string text, part;
  for (const Finding& finding : findings) {
    if (finding.part != part) text += (text.empty() ? "" : "\n") + finding.part + "\n";
    part = finding.part;
    text += line_of(finding);
  }
  if (can_run(findings)) return text + "\nThe demo can run: `onestroke run`.\n";
  text += "\nThe demo cannot run without:\n";
  for (const Finding& finding : findings)
    if (stands_in_the_way(finding)) text += line_of(finding);
  return text;
}

std::string to_json(std::span<const Finding> findings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Finding& f : findings) {
    Json value{{"part", f.part}, {"health", word_of(f.health)}, {"what", f.what}};
    if (!f.remedy.empty()) value["remedy"] = f.remedy;
    if (f.needed) value["needed"] = true;
    list.push_back(std::move(value));
  }
  return Json{{"can_run", can_run(findings)}, {"findings", std::move(list)}}.dump(2, ' ', false,
                                                                                  Json::error_handler_t::replace) +
         "\n";
}

Finding finding_of(std::string part, Health health, const std::string& message, bool needed) {
  const std::size_t colon = message.find(": ");
  const bool parted = colon != std::string::npos;
  return {.part = std::move(part),
          .health = health,
          .what = message.substr(0, colon),
          .remedy = parted ? message.substr(colon + 2) : std::string(),
          .needed = needed};
}

}  // namespace onestroke
