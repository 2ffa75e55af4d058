#pragma once

#include "tracking/image_view.h"

#include <array>
#include <cstdint>
#include <vector>

namespace onestroke {

/// Label of a pixel that is no ink.
inline constexpr std::uint8_t no_ink = 3;

struct SegmentationOptions {
  /// Gain of the blue channel against red and green before channels are compared: under 3000 K an uncorrected camera
  /// sees blue ink with less blue than red in it, under 6500 K green ink with as much blue as green; no one gain serves
  /// both.
  float blue_gain = 1.0F;
  /// The largest channel must lead the second by this share of itself, and by this many levels.
  float relative_margin = 0.12F;
  float absolute_margin = 7.0F;
  /// The same of the red channel: before surroundings or in light that is warm, green and blue ink have as much of it.
  float red_gain = 1.0F;
  /// The smallest channel must be this share of the largest: paint gives back a little of every colour, petals and lit
  /// screens hardly any.
  float least_share = 0.0F;
};

/// Which ink each pixel shows: the largest channel (0 red, 1 green, 2 blue), or no_ink. Comparing channels of one pixel
/// leaves shading out. A factor above 1 looks at the middle pixel of each square of that side only. labels is resized
/// to (width / factor) * (height / factor).
void segment(const ImageView& image, const SegmentationOptions& options, std::vector<std::uint8_t>& labels,
             int factor = 1);

/// Takes the outermost pixels off each region of one ink, and with them the seams of mixed colours along outlines that
/// join regions to one another.
void peel(int width, int height, std::vector<std::uint8_t>& labels);

/// Gaussian smoothing of packed RGB (sigma in pixels), against sensor noise. out has stride 3 * width.
void smooth(const ImageView& image, double sigma, std::vector<std::uint8_t>& out);

}  // namespace onestroke
