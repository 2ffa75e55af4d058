#include "scene/compare_modes.h"

#include <algorithm>

namespace onestroke {

namespace {

template <typename T>
bool holds(const std::optional<T>& wanted, T is) {
  return !wanted || *wanted == is;
}

std::string upper_case(char key) {
  return std::string(1, static_cast<char>(key - 'a' + 'A'));
}

std::string key_of(Sign sign) {
  const auto found = std::ranges::find(sign_keys, sign, &SignKey::sign);
  return found == sign_keys.end() ? std::string() : upper_case(found->key);
}

std::string mode_name(const std::optional<Tool>& tool, const std::optional<Link>& link) {
  if (!tool) return "any";
  if (*tool != Tool::none) return std::string(name_of(*tool));
  return std::string(link ? name_of(*link) : "any without a tool");
}

std::string result_of(const ModeRule& rule) {
  if (rule.act == Act::freeze) return "the touched model is held, or let go";
  if (rule.act == Act::snapshot) return "a snapshot is saved";
  if (rule.act == Act::menu) return "the menu is opened, or closed";
  if (rule.to_link) return std::string(name_of(*rule.to_link));
  return rule.to_tool == Tool::none ? "what was before" : std::string(name_of(rule.to_tool.value_or(Tool::none)));
}

}  // namespace

const ModeRule* find_rule(const CompareMode& mode, Sign sign) {
  const auto found = std::ranges::find_if(mode_rules, [&](const ModeRule& r) {
    return r.sign == sign && holds(r.tool, mode.tool) && holds(r.link, mode.link);
  });
  return found == mode_rules.end() ? nullptr : &*found;
}

CompareMode after(const CompareMode& mode, const ModeRule& rule) {
  return {rule.to_link.value_or(mode.link), rule.to_tool.value_or(mode.tool)};
}

std::optional<Sign> sign_of(Touch touch) {
  const auto either = [&touch](StickPoint a, StickPoint b) { return touch == Touch{a, b} || touch == Touch{b, a}; };
  if (either(StickPoint::arm, StickPoint::arm)) return Sign::arms_crossed;
  if (either(StickPoint::start, StickPoint::start)) return Sign::starts_together;
  if (either(StickPoint::end, StickPoint::end)) return Sign::ends_together;
  if (either(StickPoint::corner, StickPoint::corner)) return Sign::corners_together;
  if (either(StickPoint::start, StickPoint::corner)) return Sign::start_on_corner;
  if (either(StickPoint::start, StickPoint::end)) return Sign::start_on_end;
  return Sign::end_on_corner;
}

std::optional<Sign> sign_of(char key, const CompareMode& mode) {
  for (const SignKey& k : sign_keys)
    if (k.key == key && find_rule(mode, k.sign)) return k.sign;
  return std::nullopt;
}

std::string_view name_of(Link link) {
  constexpr std::array<std::string_view, 3> names{"side by side", "linked", "mirrored"};
  return names[static_cast<std::size_t>(link)];
}

std::string_view name_of(Tool tool) {
  constexpr std::array<std::string_view, 5> names{"none", "overlay", "best fit", "section", "measure"};
  return names[static_cast<std::size_t>(tool)];
}

std::string_view name_of(Sign sign) {
  constexpr std::array<std::string_view, 11> names{
      "start tips together",     "end tips together",        "corners together",      "corners parted",
      "start tip on the corner", "start tip on the end tip", "end tip on the corner", "start arms crossed",
      "one stick twisted",       "one stick twisted back",   "a stick out of sight"};
  return names[static_cast<std::size_t>(sign)];
}

std::string mode_table() {
  std::string table = "| in | sign | key | to | offered as |\n|---|---|---|---|---|\n";
  for (const ModeRule& r : mode_rules)
    table += "| " + mode_name(r.tool, r.link) + " | " + std::string(name_of(r.sign)) + " | " + key_of(r.sign) + " | " +
             result_of(r) + " | " + std::string(r.words) + " |\n";
  return table;
}

// What has no tool is one box with three states in it, to which tools go back.
std::string mode_diagram() {
  const auto id = [](std::string_view name) {
    std::string word(name);
    std::ranges::replace(word, ' ', '_');
    return word;
  };
  std::string text = "stateDiagram-v2\n  [*] --> without_a_tool\n  state without_a_tool {\n";
  text += "    [*] --> " + id(name_of(Link::apart)) + "\n";
  for (const ModeRule& r : mode_rules)
    if (r.link && r.to_link)
      text += "    " + id(name_of(*r.link)) + " --> " + id(name_of(*r.to_link)) + ": " + std::string(name_of(r.sign)) +
              "\n";
  text += "  }\n";
  for (const ModeRule& r : mode_rules) {
    if (!r.tool || !r.to_tool) continue;
    const auto box = [&](Tool t) { return t == Tool::none ? std::string("without_a_tool") : id(name_of(t)); };
    text += "  " + box(*r.tool) + " --> " + box(*r.to_tool) + ": " + std::string(name_of(r.sign)) + "\n";
  }
  return text;
}

std::string menu_table() {
  std::string table = "| entry | key | does |\n|---|---|---|\n";
  for (const MenuEntry& e : menu_entries)
    table += "| " + std::string(e.words) + " | " + upper_case(e.key) + " | " + std::string(e.does) + " |\n";
  return table;
}

}  // namespace onestroke
