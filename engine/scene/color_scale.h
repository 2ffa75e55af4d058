#pragma once

#include <array>

namespace onestroke {

/// Colours for signed distances: pale where there is none, purple below and orange to brown above, about as dark to
/// either side. People who cannot tell red from green tell them apart (ColorBrewer's PuOr reversed, between whose steps
/// the mean is taken in linear light).
class ColorScale {
 public:
  /// From -reach to reach, beyond which colours stay as they are at the ends.
  explicit ColorScale(double reach) : reach_(reach) {}
  /// One that shows 19 in 20 distances by their own colour: the smallest of 1, 2 and 5 times a power of ten that is not
  /// below p95; never below `least`.
  static ColorScale for_distances(double p95, double least);

  double reach() const { return reach_; }
  /// Linear red, green and blue.
  std::array<float, 3> color(double distance) const;

 private:
  double reach_;
};

}  // namespace onestroke
