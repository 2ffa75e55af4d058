#pragma once

#include "scene/touch_gesture.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace onestroke {

/// How the turns of the two models hang together.
enum class Link { apart, same, mirrored };

/// What is done with the two models besides.
enum class Tool { none, overlay, section, measure };

struct CompareMode {
  Link link = Link::apart;
  Tool tool = Tool::none;

  friend bool operator==(const CompareMode&, const CompareMode&) = default;
};

/// What changes the mode: what two sticks do, or the key that stands for it.
enum class Sign {
  starts_together,  ///< The tips of both start arms.
  corners_together,
  corners_parted,   ///< After having been together.
  start_on_corner,  ///< One stick's start tip on the other's corner.
  start_on_end,     ///< One stick's start tip on the other's end tip.
  stick_gone,       ///< One of them was not seen for a while.
};

/// One line of the table of modes. A rule without a link holds for any, and leaves it as it is.
struct ModeRule {
  Tool tool = Tool::none;
  std::optional<Link> link;
  Sign sign{};
  Tool to_tool = Tool::none;
  std::optional<Link> to_link;
  std::string_view words;  ///< What is offered while the sign is being made.
};

/// All of them. What is not here changes nothing.
inline constexpr std::array mode_rules{
    ModeRule{Tool::none, Link::apart, Sign::starts_together, Tool::none, Link::same, "Link"},
    ModeRule{Tool::none, Link::same, Sign::starts_together, Tool::none, Link::mirrored, "Mirror"},
    ModeRule{Tool::none, Link::mirrored, Sign::starts_together, Tool::none, Link::apart, "Part"},
    ModeRule{Tool::none, {}, Sign::corners_together, Tool::overlay, {}, "Lay over"},
    ModeRule{Tool::overlay, {}, Sign::corners_parted, Tool::none, {}, ""},
    ModeRule{Tool::overlay, {}, Sign::stick_gone, Tool::none, {}, ""},
    ModeRule{Tool::none, {}, Sign::start_on_corner, Tool::section, {}, "Cut"},
    ModeRule{Tool::section, {}, Sign::start_on_corner, Tool::none, {}, "End the cut"},
    ModeRule{Tool::section, {}, Sign::stick_gone, Tool::none, {}, ""},
    ModeRule{Tool::none, {}, Sign::start_on_end, Tool::measure, {}, "Measure"},
    ModeRule{Tool::measure, {}, Sign::start_on_end, Tool::none, {}, "End measuring"},
    ModeRule{Tool::measure, {}, Sign::stick_gone, Tool::none, {}, ""},
};

/// The rule for a sign in a mode; null where it means nothing there.
const ModeRule* find_rule(const CompareMode& mode, Sign sign);
CompareMode after(const CompareMode& mode, const ModeRule& rule);

/// The sign that a touch is; none where it stands for no mode.
std::optional<Sign> sign_of(Touch touch);

std::string_view name_of(Link link);
std::string_view name_of(Tool tool);
std::string_view name_of(Sign sign);

/// The table as a Markdown one, as it stands in the manual.
std::string mode_table();

}  // namespace onestroke
