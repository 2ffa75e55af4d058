#pragma once

#include "render/view.h"

#include <vulkan/vulkan_core.h>

#include <array>

namespace onestroke {

/// Where a display wants to be told how far away what it shows is. As RenderTarget's image, in a format of depth alone;
/// it is taken and given back in DEPTH_STENCIL_ATTACHMENT_OPTIMAL. The reverse way round: 1 at near_plane, 0 at
/// infinity.
struct DepthTarget {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  std::array<VkImageView, max_views> layer_views{};
  VkFormat format = VK_FORMAT_UNDEFINED;
};

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
  /// Without an image where the display does not want to know.
  DepthTarget depth{};
  /// The layout that the display takes the image back in. What it held before is not kept.
  VkImageLayout final_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  /// Waited for before the image is written; null where it is ready.
  VkSemaphore ready = VK_NULL_HANDLE;
  /// Signalled when the frame is done; null where the display waits by itself.
  VkSemaphore done = VK_NULL_HANDLE;
};

}  // namespace onestroke
