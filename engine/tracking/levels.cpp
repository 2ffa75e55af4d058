#include "tracking/levels.h"

#include "tracking/segmentation.h"

namespace onestroke {

Levels LevelMaker::make(const ImageView& picture) {
  smooth(picture, 1.0, soft_);
  smooth(picture, 3.0, softer_);
  const std::size_t stride = 3 * static_cast<std::size_t>(picture.width);
  return {picture,
          {soft_.data(), picture.width, picture.height, stride},
          {softer_.data(), picture.width, picture.height, stride}};
}

}  // namespace onestroke
