#pragma once

#include "display/openxr_api.h"
#include "render/device.h"
#include "render/view.h"

#include <array>
#include <span>
#include <vector>

namespace onestroke {

/// The first format of the runtime's own order that is among `usable`; VK_FORMAT_UNDEFINED for none. Throws
/// OpenXrError.
VkFormat choose_format(XrSession session, std::span<const VkFormat> usable);

/// Images of one kind that the runtime lends in turn: a layer for each eye.
class OpenXrImages {
 public:
  struct Kind {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D size{};
    XrSwapchainUsageFlags usage = 0;
    vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor;
  };
  struct Lent {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;                 ///< Of both layers.
    std::array<VkImageView, max_views> layer_views{};  ///< Of each.
  };

  /// Session and device outlive this. Throws OpenXrError.
  OpenXrImages(const Device& device, XrSession session, const Kind& kind);

  const Kind& kind() const { return kind_; }
  /// The next image, once the compositor has done with it; null where that takes too long, and the next call waits on.
  /// What was acquired and not released is given again. Throws OpenXrError.
  const Lent* acquire();
  /// Hands the acquired image, drawn, to the runtime. Throws OpenXrError.
  void release();
  /// What one eye sees of it.
  XrSwapchainSubImage part_for(std::uint32_t eye) const;

 private:
  void take_images(const Device& device);

  Kind kind_;
  OpenXrOwned<XrSwapchain, xrDestroySwapchain> swapchain_;
  std::vector<vk::raii::ImageView> views_;
  std::vector<Lent> images_;
  std::uint32_t index_ = 0;
  bool acquired_ = false, ready_ = false;
};

}  // namespace onestroke
