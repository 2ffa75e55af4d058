#pragma once

#include "render/view.h"

#include <cstddef>
#include <span>

namespace onestroke {

/// A ball in the world, vision axes, mm.
struct Ball {
  Vec3 centre_world{};
  double radius = 0;
};

/// At how many pixels a view shows a millimetre of what lies in the ball, at most: at the ball's nearest point. 0 where
/// all of it is behind the view, infinity where it reaches up to the eye.
double pixels_per_millimetre(const View& view, const Ball& ball);

/// An error that nobody sees, pixels.
inline constexpr double unseen_error_px = 0.5;

/// The coarsest level whose error is not seen at so many pixels a unit. `errors` is that of each level, growing from 0
/// at the full detail, which is taken where none will do.
std::size_t choose_level(std::span<const float> errors, double pixels_per_unit);

}  // namespace onestroke
