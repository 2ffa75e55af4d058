#pragma once

#include "scene/comparison_view.h"

namespace onestroke {

/// "about the stop arm" where the axis is nearly one of the stick's own, otherwise its three numbers.
void print_axis(Vec3 axis, Text& words);

/// A stick covered for less than this is not spoken of: the words would only flicker.
inline constexpr Duration mentioned_after = Duration::from_ms(200);

/// What the hand holds and how well it is seen, or that its model is held where it stands.
void print_label(const HeldMarker& held, std::string_view model_name, bool frozen, Time now, Text& words);

/// The lines that stand on the screen.
void print_hud(ComparisonView& view);

}  // namespace onestroke
