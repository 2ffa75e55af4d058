#include "scene/touch_gesture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace onestroke {

namespace {

// Speed is that from a smoothed past, so that the tracker's noise is none.
constexpr Duration memory = Duration::from_ms(150);

constexpr std::array places{StickPoint::start, StickPoint::corner, StickPoint::end};
constexpr Touch arms{StickPoint::arm, StickPoint::arm};
// The part of an arm in which another crosses it, from its middle to either side, over its length.
constexpr double crossed_part = 0.25;
// The sine of the angle at which they cross: arms that lie along each other, as where a tip is at a corner, do not.
// From the first to the second what is near counts as nearer.
constexpr double along_each_other = 0.5, across_each_other = 0.7;

/// The line along which an arm may be crossed.
struct Segment {
  Vec3 middle, half;

  Vec3 at(double t) const { return middle + t * half; }
  /// Where it is nearest to a place, from -1 to 1.
  double nearest(Vec3 place) const { return std::clamp(dot(place - middle, half) / dot(half, half), -1.0, 1.0); }
};

Segment crossing_part(const StickPoints& stick) {
  return {place_of(stick, StickPoint::arm), crossed_part * (stick[0] - stick[1])};
}

/// How near two of them cross each other, mm. Ericson, Real-Time Collision Detection, 5.1.9: the nearest place of the
/// one for the other's line, then once back.
double crossing_distance(const Segment& a, const Segment& b) {
  const double aa = dot(a.half, a.half), bb = dot(b.half, b.half), ab = dot(a.half, b.half);
  if (aa <= 0 || bb <= 0) return std::numeric_limits<double>::infinity();
  const Vec3 between = a.middle - b.middle;
  const double across = aa * bb - ab * ab;
  const double crossing =
      (std::sqrt(std::max(across / (aa * bb), 0.0)) - along_each_other) / (across_each_other - along_each_other);
  if (crossing <= 0) return std::numeric_limits<double>::infinity();
  const double s = std::clamp((ab * dot(b.half, between) - bb * dot(a.half, between)) / across, -1.0, 1.0);
  const Vec3 on_b = b.at(b.nearest(a.at(s)));
  return norm(a.at(a.nearest(on_b)) - on_b) / std::min(crossing, 1.0);
}

}  // namespace

Vec3 place_of(const StickPoints& stick, StickPoint p) {
  return p == StickPoint::arm ? 0.5 * (stick[0] + stick[1]) : stick[static_cast<std::size_t>(p)];
}

double TouchGesture::near(Touch touch) {
  return touch == Touch{StickPoint::corner, StickPoint::corner} ? near_corners_mm : near_mm;
}

double TouchGesture::distance(const std::array<StickPoints, 2>& sticks, Touch touch) {
  if (touch == arms) return crossing_distance(crossing_part(sticks[0]), crossing_part(sticks[1]));
  return norm(place_of(sticks[1], touch.right) - place_of(sticks[0], touch.left));
}

// Distances count by how near their places must come, so that corners do not hide tips.
TouchGesture::Nearest TouchGesture::nearest(const std::array<StickPoints, 2>& sticks) {
  Nearest found{.distance = std::numeric_limits<double>::infinity(), .second = std::numeric_limits<double>::infinity()};
  const auto look_at = [&](Touch touch) {
    const double away = distance(sticks, touch) / near(touch);
    if (away < found.distance) {
      found.second = found.distance;
      found.distance = away;
      found.touch = touch;
    } else {
      found.second = std::min(found.second, away);
    }
  };
  for (const StickPoint left : places)
    for (const StickPoint right : places) look_at({left, right});
  look_at(arms);
  found.between = place_of(sticks[1], found.touch.right) - place_of(sticks[0], found.touch.left);
  return found;
}

void TouchGesture::exchange() {
  std::swap(last_.left, last_.right);
  for (std::optional<Touch>* touch : {&candidate_, &approached_})
    if (*touch) std::swap((*touch)->left, (*touch)->right);
  between_ = -between_;
}

void TouchGesture::let_go() {
  candidate_.reset();
  held_for_ = {};
  progress_ = 0;
}

std::optional<Touch> TouchGesture::update(const std::optional<std::array<StickPoints, 2>>& sticks, Time now) {
  const Duration step = now - seen_;
  if (!sticks) {
    if (step > longest_gap) {
      approached_.reset();
      let_go();
    }
    return std::nullopt;
  }
  seen_ = now;
  approached_.reset();
  if (!armed_) {
    armed_ = distance(*sticks, last_) > parted_factor * near(last_);
    return std::nullopt;
  }
  const Nearest found = nearest(*sticks);
  if (found.distance < approach_factor && found.second > clearly_nearer * found.distance) approached_ = found.touch;
  const bool goes_on = candidate_ == found.touch && step <= longest_gap;
  if (found.distance > (goes_on ? hold_factor : 1) || found.second < clearly_nearer * found.distance) {
    let_go();
    return std::nullopt;
  }
  if (!goes_on) {
    let_go();
    candidate_ = found.touch;
    between_ = found.between;
    return std::nullopt;
  }
  const double speed = norm(found.between - between_) / memory.seconds();
  between_ = between_ + (1 - std::exp(-step.seconds() / memory.seconds())) * (found.between - between_);
  // What moves runs back at the rate at which holding still fills.
  held_for_ = speed > still_mm_s ? std::max(held_for_ - step, Duration{}) : held_for_ + step;
  progress_ = std::clamp(held_for_.seconds() / hold.seconds(), 0.0, 1.0);
  if (held_for_ < hold) return std::nullopt;
  armed_ = false;
  last_ = found.touch;
  approached_.reset();
  let_go();
  return last_;
}

}  // namespace onestroke
