#pragma once

#include "render/view.h"

#include <optional>
#include <span>
#include <string_view>

namespace onestroke {

/// A label and what it belongs to: a ball in the world that it must not cover.
struct LabelWish {
  std::string_view text;
  Vec3 centre_world;
  double reach = 0;  ///< mm
};

struct LabelPlace {
  Vec3 position_world;  ///< Of the label's lower middle.
  Vec3 leader_world;    ///< Inside the ball: where a line from the label leads.
  double height_px = 0;
};

struct CardPlace {
  Vec3 position_world;  ///< Of its upper left corner.
  double height_px = 0;
};

/// On which side of its ball a text of several lines has room: that which is asked for, where both have or neither has.
bool card_fits_right(const View& view, const LabelWish& card, bool wanted);
/// Puts it there, inside the view. Moves without jumps as the ball does.
CardPlace place_card(const View& view, const LabelWish& card, bool to_right);

/// Puts each label above its ball as the view sees it, inside the view, and lifts the first where two would overlap.
/// Moves without jumps as the balls do. No place for what is behind the view.
void place_labels(const View& view, std::span<const LabelWish> wishes, std::span<std::optional<LabelPlace>> places);

}  // namespace onestroke
