#include "render/level_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace onestroke {

namespace {

constexpr double nearest = 20;  // mm: what is nearer than that is not drawn

}  // namespace

double pixels_per_millimetre(const View& view, const Ball& ball) {
  const Vec3 centre = inverse(view.T_world_view) * ball.centre_world;
  if (centre.z + ball.radius < nearest) return 0;
  const double depth = centre.z - ball.radius;
  if (depth < nearest) return std::numeric_limits<double>::infinity();
  const Fov& f = view.fov;
  const double focal = std::max(view.viewport.width / (f.right - f.left), view.viewport.height / (f.up - f.down));
  // A plane picture stretches what is off its middle; the view's own corner is the farthest.
  const double corner = std::hypot(std::max(f.right, -f.left), std::max(f.up, -f.down));
  const double off_axis = std::min((std::hypot(centre.x, centre.y) + ball.radius) / depth, corner);
  return focal / depth * std::hypot(1.0, off_axis);
}

std::size_t choose_level(std::span<const float> errors, double pixels_per_unit) {
  std::size_t level = 0;
  for (std::size_t i = 1; i < errors.size(); ++i)
    if (double{errors[i]} * pixels_per_unit < unseen_error_px) level = i;
  return level;
}

}  // namespace onestroke
