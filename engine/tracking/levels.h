#pragma once

#include "tracking/image_view.h"

#include <vector>

namespace onestroke {

/// A picture as taken and smoothed against noise, twice.
struct Levels {
  ImageView sharp, soft, softer;

  /// The one to measure a rod in: where a cell spans many pixels a smoothed picture loses nothing but noise.
  const ImageView& for_pitch(double pixels) const { return pixels > 14 ? softer : pixels > 10 ? soft : sharp; }
};

/// Memory for the levels of one picture after another.
class LevelMaker {
 public:
  /// The levels borrow the picture and this object's memory.
  Levels make(const ImageView& picture);

 private:
  std::vector<std::uint8_t> soft_, softer_;
};

}  // namespace onestroke
