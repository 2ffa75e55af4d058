#pragma once

#include <cmath>
#include <concepts>

namespace onestroke {

/// From sRGB's code to linear light, both 0 to 1 (IEC 61966-2-1).
template <std::floating_point T>
T linear_from_srgb(T coded) {
  return coded <= T(0.04045) ? coded / T(12.92) : std::pow((coded + T(0.055)) / T(1.055), T(2.4));
}

}  // namespace onestroke
