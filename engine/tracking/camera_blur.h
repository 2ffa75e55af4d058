#pragma once

#include <algorithm>
#include <cmath>

namespace onestroke {

/// How far a camera blurs what lies at a depth: standard deviations along an axis, pixels of a picture or a plane. What
/// is out of focus is blurred in proportion to how far its nearness (1 / depth) is off that of what is in focus.
struct CameraBlur {
  double sigma = 0.6;      ///< At the depth `middle`; below 0 where more nearness, not less, brings it into focus.
  double by_nearness = 0;  ///< Added to it where a thing is twice as near.
  double middle = 1;       ///< mm.

  /// By the thin lens alone, of either sign.
  double defocus(double depth) const { return sigma + by_nearness * (middle / depth - 1); }
  double at(double depth) const { return std::max(0.3, std::abs(defocus(depth))); }
  CameraBlur scaled(double by) const { return {sigma * by, by_nearness * by, middle}; }
};

}  // namespace onestroke
