#pragma once

#include "core/pose.h"
#include "core/time.h"

#include <cstddef>
#include <span>

namespace onestroke {

/// Where the head was at the time that a picture was reckoned to be exposed, and how its camera saw a marker that lies
/// still. Vision axes; translations are not used.
struct ClockSight {
  Time time;
  Pose T_world_head;
  Pose T_camera_marker;
};

/// How much later than reckoned the pictures were exposed.
struct ClockOffset {
  Duration offset, deviation;
  std::size_t used = 0;     ///< Pairs of pictures.
  double residual_deg = 0;  ///< Median of what is left between how head and camera turned.
};

inline constexpr std::size_t fewest_clock_sights = 60;
inline constexpr Duration widest_clock_offset = Duration::from_ms(150);
/// How fast a head must turn, for half of the sights at least.
inline constexpr double slowest_clock_turn_deg_s = 15;

/// How fast the head turned, rad/s: the median over neighbouring sights, in the order of their times.
double median_turn_speed(std::span<const ClockSight> sights);

/// The offset between the clock of a camera's pictures and that of the head that carries it, from a marker that lies
/// still and a head that turns to and fro. Where the camera sits in the head need not be known: how the camera turned
/// between two pictures is how the head turned between two times, seen in other axes, and these (Wahba's problem, by
/// singular values: Markley 1988) and the offset are what leaves least between the two. What does not agree counts for
/// less (Tukey). The deviation is a jackknife's over stretches of the recording. Sights in the order of their times.
/// Throws Error where they do not tell it, with what to do.
ClockOffset find_clock_offset(std::span<const ClockSight> sights);

}  // namespace onestroke
