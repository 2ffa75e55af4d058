#pragma once

#include "render/resources.h"
#include "render/target.h"

#include <array>

namespace onestroke {

/// An image of one's own to draw frames into, a layer for each view, and to copy them from.
class ImageTarget {
 public:
  ImageTarget() = default;
  ImageTarget(Device& device, vk::Format format, int width, int height, int views, VkImageLayout final_layout);

  const Image& image() const { return image_; }
  const RenderTarget& target() const { return target_; }

 private:
  Image image_;
  std::array<vk::raii::ImageView, max_views> layers_{nullptr, nullptr};
  RenderTarget target_;
};

}  // namespace onestroke
