#pragma once

#include "scene/touch_gesture.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace onestroke {

/// How the turns of the two models hang together.
enum class Link { apart, same, mirrored };

/// What is done with the two models besides. Laid over each other they are aligned by their own frames, or fitted.
enum class Tool { none, overlay, fitted, section, measure };

struct CompareMode {
  Link link = Link::apart;
  Tool tool = Tool::none;

  bool laid_over() const { return tool == Tool::overlay || tool == Tool::fitted; }
  friend bool operator==(const CompareMode&, const CompareMode&) = default;
};

/// What changes the mode: what two sticks do, or the key that stands for it.
enum class Sign {
  starts_together,  ///< The tips of both start arms.
  ends_together,    ///< The tips of both end arms.
  corners_together,
  corners_parted,   ///< After having been together.
  start_on_corner,  ///< One stick's start tip on the other's corner.
  start_on_end,     ///< One stick's start tip on the other's end tip.
  end_on_corner,    ///< One stick's end tip on the other's corner.
  arms_crossed,     ///< Both start arms, away from their ends.
  twisted,          ///< One turned far against the other, since they were brought together.
  untwisted,        ///< And back.
  stick_gone,       ///< One of them was not seen for a while.
};

/// What happens once, besides a change of the mode.
enum class Act { none, freeze, snapshot, menu };

/// One line of the table of modes. What a rule leaves open holds for any, and stays as it is.
struct ModeRule {
  std::optional<Tool> tool;
  std::optional<Link> link;
  Sign sign{};
  std::optional<Tool> to_tool;
  std::optional<Link> to_link;
  std::string_view words;  ///< What is offered while the sign is being made.
  Act act = Act::none;
};

/// All of them. What is not here changes nothing.
inline constexpr std::array mode_rules{
    ModeRule{Tool::none, Link::apart, Sign::starts_together, {}, Link::same, "Link"},
    ModeRule{Tool::none, Link::same, Sign::starts_together, {}, Link::mirrored, "Mirror"},
    ModeRule{Tool::none, Link::mirrored, Sign::starts_together, {}, Link::apart, "Unlink"},
    ModeRule{Tool::none, {}, Sign::corners_together, Tool::overlay, {}, "Lay over"},
    ModeRule{Tool::overlay, {}, Sign::twisted, Tool::fitted, {}, "Best fit"},
    ModeRule{Tool::fitted, {}, Sign::untwisted, Tool::overlay, {}, "Own frames"},
    ModeRule{Tool::overlay, {}, Sign::corners_parted, Tool::none, {}, ""},
    ModeRule{Tool::fitted, {}, Sign::corners_parted, Tool::none, {}, ""},
    ModeRule{Tool::overlay, {}, Sign::stick_gone, Tool::none, {}, ""},
    ModeRule{Tool::fitted, {}, Sign::stick_gone, Tool::none, {}, ""},
    ModeRule{Tool::none, {}, Sign::start_on_corner, Tool::section, {}, "Cut"},
    ModeRule{Tool::section, {}, Sign::start_on_corner, Tool::none, {}, "End the cut"},
    ModeRule{Tool::section, {}, Sign::stick_gone, Tool::none, {}, ""},
    ModeRule{Tool::none, {}, Sign::start_on_end, Tool::measure, {}, "Measure"},
    ModeRule{Tool::measure, {}, Sign::start_on_end, Tool::none, {}, "End measuring"},
    ModeRule{Tool::measure, {}, Sign::stick_gone, Tool::none, {}, ""},
    ModeRule{{}, {}, Sign::end_on_corner, {}, {}, "Freeze", Act::freeze},
    ModeRule{{}, {}, Sign::ends_together, {}, {}, "Snapshot", Act::snapshot},
    ModeRule{{}, {}, Sign::arms_crossed, {}, {}, "Menu", Act::menu},
};

/// The rule for a sign in a mode; null where it means nothing there.
const ModeRule* find_rule(const CompareMode& mode, Sign sign);
CompareMode after(const CompareMode& mode, const ModeRule& rule);

/// The sign that a touch is; none where it stands for nothing.
std::optional<Sign> sign_of(Touch touch);

/// Which key stands for a sign.
struct SignKey {
  char key;
  Sign sign;
};
inline constexpr std::array sign_keys{SignKey{'l', Sign::starts_together}, SignKey{'o', Sign::corners_together},
                                      SignKey{'o', Sign::corners_parted},  SignKey{'b', Sign::twisted},
                                      SignKey{'b', Sign::untwisted},       SignKey{'c', Sign::start_on_corner},
                                      SignKey{'m', Sign::start_on_end},    SignKey{'f', Sign::end_on_corner},
                                      SignKey{'p', Sign::ends_together},   SignKey{'n', Sign::arms_crossed}};
/// The sign that a key stands for in a mode; none where it means nothing there.
std::optional<Sign> sign_of(char key, const CompareMode& mode);

/// What the menu offers, and the key that does the same: a sign's, or one that the program knows besides.
struct MenuEntry {
  char key;
  std::string_view words;  ///< Where the mode has none of its own.
  std::string_view does;
};
/// Row by row, menu_columns in each.
inline constexpr std::array menu_entries{
    MenuEntry{'l', "Link", "links the two models, mirrors them, parts them again"},
    MenuEntry{'o', "Lay over", "lays one model over the other, or ends that"},
    MenuEntry{'b', "Best fit", "lays it by the best fit, or by their own frames"},
    MenuEntry{'c', "Cut", "cuts one model by the other's stick, or ends that"},
    MenuEntry{'m', "Measure", "measures, or ends that"},
    MenuEntry{'f', "Freeze", "holds a model where it is, or lets it go"},
    MenuEntry{'p', "Snapshot", "saves a snapshot"},
    MenuEntry{'i', "Cards", "shows or hides what is known of the models"},
    MenuEntry{'h', "Words", "shows or hides words and figures"},
    MenuEntry{'x', "Exchange hands", "exchanges the hands"},
    MenuEntry{'r', "Recentre", "puts the world's origin where the head is, in a headset"},
    MenuEntry{'q', "Leave", "ends the program"}};
inline constexpr int menu_columns = 3;

std::string_view name_of(Link link);
std::string_view name_of(Tool tool);
std::string_view name_of(Sign sign);

/// The table as a Markdown one, and as a diagram in Mermaid's words, as they stand in the manual.
std::string mode_table();
std::string mode_diagram();
/// The menu's entries as a Markdown table, too.
std::string menu_table();

}  // namespace onestroke
