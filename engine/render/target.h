#pragma once

#include <vulkan/vulkan_core.h>

namespace onestroke {

/// The image that a display wants a frame in: a layer for each view. The format is an sRGB one: shaders write linear
/// values. Used as a colour attachment and, where there are several layers, as a destination of transfers.
struct RenderTarget {
  VkImage image = VK_NULL_HANDLE;
  /// Of all layers: 2D where there is one, otherwise 2D_ARRAY.
  VkImageView view = VK_NULL_HANDLE;
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
