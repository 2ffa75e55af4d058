#include "scene/touch_gesture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace onestroke {

namespace {

// Speed is that from a smoothed past, so that the tracker's noise is none.
constexpr Duration memory = Duration::from_ms(150);

constexpr std::array all_points{StickPoint::start, StickPoint::corner, StickPoint::end};

const Vec3& at(const StickPoints& stick, StickPoint p) {
  return stick[static_cast<std::size_t>(p)];
}

}  // namespace

double TouchGesture::near(Touch touch) {
  return touch == Touch{StickPoint::corner, StickPoint::corner} ? near_corners_mm : near_mm;
}

// Distances count by how near their places must come, so that corners do not hide tips.
TouchGesture::Nearest TouchGesture::nearest(const std::array<StickPoints, 2>& sticks) {
  Nearest found{.distance = std::numeric_limits<double>::infinity(), .second = std::numeric_limits<double>::infinity()};
  for (const StickPoint left : all_points)
    for (const StickPoint right : all_points) {
      const Touch touch{left, right};
      const Vec3 between = at(sticks[1], right) - at(sticks[0], left);
      const double distance = norm(between) / near(touch);
      if (distance < found.distance) {
        found.second = found.distance;
        found.distance = distance;
        found.touch = touch;
        found.between = between;
      } else {
        found.second = std::min(found.second, distance);
      }
    }
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
    const Vec3 between = at((*sticks)[1], last_.right) - at((*sticks)[0], last_.left);
    armed_ = norm(between) > parted_factor * near(last_);
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
