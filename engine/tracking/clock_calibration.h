#pragma once

#include "core/time.h"
#include "tracking/head_calibration.h"

#include <cstddef>
#include <span>

namespace onestroke {

/// A sight of a marker that lies still, with the head where it was at the time that the picture is reckoned to be
/// exposed.
struct ClockSight {
  Time time;
  HeadSight sight;
};

/// How much later than reckoned the pictures were exposed.
struct ClockOffset {
  Duration offset, deviation;
  std::size_t used = 0;     ///< Sights that agree with one another.
  double residual_px = 0;   ///< Of the marker's origin in them, rms; 0 without a focal length.
  double residual_deg = 0;  ///< Of how they are turned.
};

inline constexpr std::size_t fewest_clock_sights = 60;
inline constexpr Duration widest_clock_offset = Duration::from_ms(150);
/// How fast a head must turn, for half of the sights at least, and how far about a second axis.
inline constexpr double slowest_clock_turn_deg_s = 15, least_clock_turn_deg = 4;

/// How fast the head turned, rad/s: the median over neighbouring sights, in the order of their times.
double median_turn_speed(std::span<const ClockSight> sights);

/// The offset between the clock of a camera's pictures and that of the head that carries it, from a marker that lies
/// still and a head that turns to and fro. A first look compares how the camera turned between two pictures with how
/// the head turned between two times: the one is the other in other axes (Wahba's problem: Markley 1988). Then the
/// offset, how the head carries the camera and where the marker lies are fitted together, each sight weighed by its
/// covariance. What does not agree is left out. The deviation is a jackknife's over stretches of the recording. Sights
/// in the order of their times. Throws Error where they do not tell it, with what to do.
ClockOffset find_clock_offset(std::span<const ClockSight> sights, double focal_px = 0);

}  // namespace onestroke
