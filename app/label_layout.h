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

/// Where a label's lower middle goes, and the line from it to its ball's centre.
struct LabelPlace {
  Vec3 position_world;
  double height_px = 0;
};

/// Puts each label above its ball as the view sees it, inside the view, and lifts the first where two would overlap.
/// Moves without jumps as the balls do. No place for what is behind the view.
void place_labels(const View& view, std::span<const LabelWish> wishes, std::span<std::optional<LabelPlace>> places);

}  // namespace onestroke
