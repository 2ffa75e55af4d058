#include "tracking/sharpen.h"

#include <array>
#include <cmath>

namespace onestroke {
namespace {

// From as far as a shutter that rolls may have put the pose off to the edges themselves.
constexpr std::array<LineOptions, 4> passes{{{8}, {5}, {4}, {4, 1.2, 80, 1.7}}};
// Cells shorter than this, pixels, run together.
constexpr double min_pitch = 8;
// Lines that scatter more, pixels, are of a picture out of focus; and a pose less certain than this, radians, is better
// left to the whole look.
constexpr double max_rms = 0.42, max_turn_sigma = 0.007;
// Of the ring edges in sight.
constexpr double min_shown = 0.3;
// The same of a pose that the whole look proved, as ring edges alone did not.
constexpr double max_turn_sigma_by_look = 0.0035, min_shown_by_look = 0.6;
// How far a pose may be put right, radians; where the shutter rolls, what that does comes on top: a turn of the marker
// in a second, read out over 30 ms.
constexpr double max_turn = 0.03, max_rolling_turn = 0.19;

}  // namespace

bool Sharpener::sharpen(const TimedView& view, const RodModel& rod, Detection& d) {
  const EigenPose before = d.refinement.pose;
  if (!rod.has_roll() || pitch_in_pixels(view.intrinsics, rod, before) < min_pitch) return false;
  Motion start;
  start.pose = before;
  LineFit fit = fitter_.fit(view, rod, d.inks, start, MotionPrior{}, passes);
  // From so far off the first passes neither find every edge nor end where they would stay.
  if (view.clock.rolls() && fit.valid && (!fit.settled() || angle_between(before, fit.motion.pose) > max_turn))
    fit = fitter_.fit(view, rod, d.inks, fit.motion, MotionPrior{}, passes);
  const bool by_look = d.likelihood > 0;
  if (!fit.settled() || fit.rms > max_rms || fit.shown < (by_look ? min_shown_by_look : min_shown) * fit.expected)
    return false;
  const Matrix6d covariance = fit.pose_covariance();
  const double turn_sigma = std::sqrt(covariance.topLeftCorner<3, 3>().diagonal().maxCoeff());
  // Written so that what is not a number is refused.
  if (!(turn_sigma <= (by_look ? max_turn_sigma_by_look : max_turn_sigma))) return false;
  if (angle_between(before, fit.motion.pose) > (view.clock.rolls() ? max_rolling_turn : max_turn)) return false;
  d.refinement.pose = fit.motion.pose;
  d.refinement.covariance = covariance;
  d.as_expected = false;
  take_velocity(view, fit, d);
  return true;
}

}  // namespace onestroke
