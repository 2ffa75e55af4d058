#pragma once

#include "core/picture.h"

#include <array>

namespace onestroke {

/// Red, green, blue.
using Rgb = std::array<float, 3>;

/// The colour of a pixel as the picture codes it, 0 to 1 (NV12 and YUYV: BT.601, limited range). The pixel is inside.
Rgb coded_at(const Picture& picture, int x, int y);
/// Its brightness alone, 0 to 255: green, grey or Y.
int brightness_at(const Picture& picture, int x, int y);

/// From sRGB's code to linear light, both 0 to 1.
Rgb linear_of(const Rgb& coded);

/// How much of a colour's light the eye sees as brightness (Rec. 709).
inline float luminance(const Rgb& linear) {
  return 0.2126F * linear[0] + 0.7152F * linear[1] + 0.0722F * linear[2];
}

/// The camera's noise at mid grey: standard deviation in coded levels, 0 to 1. Immerkaer's Laplacian, which is blind to
/// slopes, in blocks all over the picture; their median, so that edges do not count.
float noise_of(const Picture& picture);

}  // namespace onestroke
