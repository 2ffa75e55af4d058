#include "scene/link_gesture.h"

#include <algorithm>

namespace onestroke {

bool LinkGesture::update(std::optional<double> distance, Time now) {
  progress_ = 0;
  if (!armed_) {
    armed_ = distance && *distance > parted_mm;
    return false;
  }
  if (!distance || *distance > (holding_ ? still_near_mm : near_mm)) {
    holding_ = false;
    return false;
  }
  if (!holding_) since_ = now;
  holding_ = true;
  if (now - since_ < hold) {
    progress_ = std::clamp((now - since_).seconds() / hold.seconds(), 0.0, 1.0);
    return false;
  }
  armed_ = holding_ = false;
  return true;
}

}  // namespace onestroke
