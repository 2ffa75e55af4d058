#include "display/pinch_tap.h"

namespace onestroke {

bool PinchTap::update(const std::optional<double>& apart_mm, Time now) {
  if (!apart_mm) {
    stage_ = Stage::unknown;
    return false;
  }
  const bool open = *apart_mm > open_mm, together = *apart_mm < together_mm;
  switch (stage_) {
    case Stage::unknown:
      if (open) {
        stage_ = Stage::open;
        since_ = now;
      }
      return false;
    case Stage::open:
      if (together) {
        stage_ = now - since_ < open_before ? Stage::unknown : Stage::together;
        since_ = now;
      }
      return false;
    case Stage::together:
      if (now - since_ > longest)
        stage_ = Stage::unknown;
      else if (open) {
        stage_ = Stage::open;
        since_ = now;
        return true;
      }
      return false;
  }
  return false;
}

HandTaps::Tap HandTaps::update(const std::optional<HandPinch>& hand, Time now) {
  std::optional<double> forefinger, middle_finger;
  if (hand) {
    forefinger = hand->forefinger_mm;
    if (hand->forefinger_mm > PinchTap::together_mm) middle_finger = hand->middle_finger_mm;
  }
  const bool first = forefinger_.update(forefinger, now), second = middle_finger_.update(middle_finger, now);
  return first ? Tap::forefinger : second ? Tap::middle_finger : Tap::none;
}

}  // namespace onestroke
