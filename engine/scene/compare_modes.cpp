#include "scene/compare_modes.h"

#include <algorithm>

namespace onestroke {

const ModeRule* find_rule(const CompareMode& mode, Sign sign) {
  const auto found = std::ranges::find_if(mode_rules, [&](const ModeRule& r) {
    return r.tool == mode.tool && r.sign == sign && (!r.link || *r.link == mode.link);
  });
  return found == mode_rules.end() ? nullptr : &*found;
}

CompareMode after(const CompareMode& mode, const ModeRule& rule) {
  return {rule.to_link.value_or(mode.link), rule.to_tool};
}

std::optional<Sign> sign_of(Touch touch) {
  const auto either = [&touch](StickPoint a, StickPoint b) { return touch == Touch{a, b} || touch == Touch{b, a}; };
  if (either(StickPoint::start, StickPoint::start)) return Sign::starts_together;
  if (either(StickPoint::corner, StickPoint::corner)) return Sign::corners_together;
  if (either(StickPoint::start, StickPoint::corner)) return Sign::start_on_corner;
  if (either(StickPoint::start, StickPoint::end)) return Sign::start_on_end;
  return std::nullopt;
}

std::string_view name_of(Link link) {
  constexpr std::array<std::string_view, 3> names{"side by side", "linked", "mirrored"};
  return names[static_cast<std::size_t>(link)];
}

std::string_view name_of(Tool tool) {
  constexpr std::array<std::string_view, 4> names{"none", "overlay", "section", "measure"};
  return names[static_cast<std::size_t>(tool)];
}

std::string_view name_of(Sign sign) {
  constexpr std::array<std::string_view, 6> names{"start tips together",      "corners together",
                                                  "corners parted",           "start tip on the corner",
                                                  "start tip on the end tip", "a stick out of sight"};
  return names[static_cast<std::size_t>(sign)];
}

std::string mode_table() {
  const auto mode = [](Tool tool, const std::optional<Link>& link) {
    if (tool != Tool::none) return std::string(name_of(tool));
    return std::string(link ? name_of(*link) : "any without a tool");
  };
  std::string table = "| in | sign | to | offered as |\n|---|---|---|---|\n";
  for (const ModeRule& r : mode_rules) {
    const bool back = r.tool != Tool::none && r.to_tool == Tool::none;
    table += "| " + mode(r.tool, r.link) + " | " + std::string(name_of(r.sign)) + " | " +
             (back ? "what was before" : mode(r.to_tool, r.to_link)) + " | " + std::string(r.words) + " |\n";
  }
  return table;
}

}  // namespace onestroke
