#include "scene/sign_finder.h"

#include <algorithm>
#include <numbers>

namespace onestroke {

namespace {

MadeSign made_by(Touch touch) {
  MadeSign made{*sign_of(touch), std::nullopt};
  if (touch.left == touch.right) return made;
  // The tip points: a start tip before an end tip.
  const bool left =
      touch.left == StickPoint::start || (touch.left == StickPoint::end && touch.right != StickPoint::start);
  made.pointer = left ? Hand::left : Hand::right;
  return made;
}

Vec3 between(const StickPair& sticks, Touch touch) {
  return 0.5 * (place_of(sticks.points[0], touch.left) + place_of(sticks.points[1], touch.right));
}

}  // namespace

std::optional<MadeSign> SignFinder::update(const StickPair& sticks, const CompareMode& mode, Time now) {
  const std::optional<Touch> touched =
      touch_.update(sticks.both_visible ? std::optional(sticks.points) : std::nullopt, now);
  const std::optional<Sign> twist = watch_twist(sticks, mode, now);
  make_offer(sticks, mode);
  const auto meant = [&](MadeSign made) { return find_rule(mode, made.sign) ? std::optional(made) : std::nullopt; };
  if (!sticks.both_held) return meant({Sign::stick_gone, {}});
  if (corners_held_ && !touch_.held()) {
    corners_held_ = false;
    return meant({Sign::corners_parted, {}});
  }
  if (touched) {
    const MadeSign made = made_by(*touched);
    corners_held_ = made.sign == Sign::corners_together;
    return meant(made);
  }
  if (twist) return meant({*twist, {}});
  return std::nullopt;
}

void SignFinder::exchange() {
  touch_.exchange();
  untwisted_ = untwisted_.conjugate();
}

// Whether a stick is twisted is a matter of the hands; what that means, one of the mode.
std::optional<Sign> SignFinder::watch_twist(const StickPair& sticks, const CompareMode& mode, Time now) {
  twist_progress_ = 0;
  if (!mode.laid_over()) {
    laid_over_ = false;
    return std::nullopt;
  }
  if (!laid_over_) {
    laid_over_ = true;
    twisted_ = false;
    untwisted_ = sticks.right_to_left;
    twisting_since_.reset();
  }
  // Sticks that are not held together turn as they like.
  if (!sticks.both_visible || !corners_held_) return std::nullopt;
  const double turned = angle_between(sticks.right_to_left, untwisted_) * 180 / std::numbers::pi;
  const bool changing = twisted_ ? turned < untwisted_deg : turned > twisted_deg;
  if (!changing) {
    twisting_since_.reset();
    return std::nullopt;
  }
  if (!twisting_since_) twisting_since_ = now;
  const Duration turning = now - *twisting_since_;
  twist_progress_ = std::clamp(turning.seconds() / twisted_for.seconds(), 0.0, 1.0);
  if (turning < twisted_for) return std::nullopt;
  twisted_ = !twisted_;
  twisting_since_.reset();
  twist_progress_ = 0;
  return twisted_ ? Sign::twisted : Sign::untwisted;
}

void SignFinder::make_offer(const StickPair& sticks, const CompareMode& mode) {
  offer_.reset();
  const auto offer = [&](MadeSign made, Vec3 place, double progress) {
    if (find_rule(mode, made.sign)) offer_ = OfferedSign{made, place, progress};
  };
  if (twist_progress_ > 0) {
    constexpr Touch corners{StickPoint::corner, StickPoint::corner};
    offer({twisted_ ? Sign::untwisted : Sign::twisted, {}}, between(sticks, corners), twist_progress_);
  } else if (const std::optional<Touch>& touch = touch_.candidate() ? touch_.candidate() : touch_.approached()) {
    offer(made_by(*touch), between(sticks, *touch), touch_.progress());
  }
}

}  // namespace onestroke
