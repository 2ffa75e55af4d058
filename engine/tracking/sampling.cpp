#include "tracking/sampling.h"

namespace onestroke {

ColorLanes sample_corner(const ImageView& image, const PicturePoint& p) {
  constexpr double one = 1 << PicturePoint::bits;
  const Color c = image.sample(p.x / one + 0.5, p.y / one + 0.5);
  return {c[0], c[1], c[2], 0};
}

}  // namespace onestroke
