#pragma once

#include "render/view.h"

#include <vulkan/vulkan_core.h>

#include <array>

namespace onestroke {

/// The image that a display wants a frame in: a layer for each view. The format is an sRGB one: shaders write linear
/// values. Used as a colour attachment.
struct RenderTarget {
  VkImage image = VK_NULL_HANDLE;
  /// Of all layers: 2D where there is one, otherwise 2D_ARRAY.
  VkImageView view = VK_NULL_HANDLE;
  /// 2D, of each layer by itself where there are several.
  std::array<VkImageView, max_views> layer_views{};
  VkFormat format = VK_FORMAT_UNDEFINED;
  int width = 0, height = 0;
  int layers = 1;
  /// The layout that the display takes the image back in. What it held before is not kept.
  VkImageLayout final_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  /// Waited for before the image is written; null where it is ready.
  VkSemaphore ready = VK_NULL_HANDLE;
  /// Signalled when the frame is done; null where the display waits by itself.
  VkSemaphore done = VK_NULL_HANDLE;
};

}  // namespace onestroke
