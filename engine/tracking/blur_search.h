#pragma once

#include "tracking/camera_blur.h"

#include <functional>
#include <span>

namespace onestroke {

/// What a blur is worth; the lowest double where nothing shows with it.
using BlurWorth = std::function<double(const CameraBlur&)>;

/// Of blurs that are the same at every depth, in rising order, the one that is worth most.
CameraBlur best_even_blur(const CameraBlur& start, std::span<const double> sigmas, const BlurWorth& worth);
/// The same among those near the start: narrower or wider by what is usual from one of them to the next but one.
CameraBlur best_even_blur_near_by(const CameraBlur& start, std::span<const double> sigmas, const BlurWorth& worth);

/// The depths between which a thing lies, mm.
struct DepthRange {
  double near, far;
};

/// How to search for the blurs of a thing's nearest and farthest points.
struct EndBlurs {
  std::span<const double> candidates;  ///< Pixels, of either sign, or
  bool relative = false;               ///< times what they are.
  int rounds = 1;
  double widest = 9;  ///< Pixels.
};

/// Changes the blurs of both ends in turn for what is worth more, as many rounds as something is found. Unchanged
/// where the ends lie too near to one another to differ.
CameraBlur best_blur_by_depth(const CameraBlur& start, const DepthRange& range, const EndBlurs& search,
                              const BlurWorth& worth);

}  // namespace onestroke
