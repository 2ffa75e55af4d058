#include "app/sights.h"

#include <algorithm>
#include <numbers>

namespace onestroke {

bool tells_pose(const MarkerObservation& marker) {
  // A pose that is known worse about any axis tells nothing.
  constexpr double worst = 3 * std::numbers::pi / 180;
  return marker.state == MarkerState::measured &&
         std::max({marker.covariance[0], marker.covariance[7], marker.covariance[14]}) < worst * worst;
}

}  // namespace onestroke
