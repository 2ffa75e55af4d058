#pragma once

#include "display/openxr_api.h"
#include "render/device.h"
#include "render/target.h"

namespace onestroke {

/// The images that the runtime shows in turn: a layer for each eye, all of one size.
class OpenXrSwapchain {
 public:
  /// Session and device outlive this. `copied`: images are copied from, too. Throws Error where the runtime takes no
  /// sRGB image.
  OpenXrSwapchain(const Device& device, XrSession session, VkExtent2D size, bool copied);

  /// The next image, once the compositor has done with it; null where that takes too long, and the next call waits on.
  /// What was acquired and not released is given again. Throws OpenXrError.
  const RenderTarget* acquire();
  /// Hands the acquired image, drawn, to the runtime. Throws OpenXrError.
  void release();

  /// What a layer shows to one eye.
  XrSwapchainSubImage part_for(std::uint32_t eye) const;

 private:
  void make_targets(const Device& device);

  VkFormat format_;
  VkExtent2D size_;
  OpenXrOwned<XrSwapchain, xrDestroySwapchain> swapchain_;
  std::vector<vk::raii::ImageView> views_;
  std::vector<RenderTarget> targets_;
  std::uint32_t index_ = 0;
  bool acquired_ = false, ready_ = false;
};

}  // namespace onestroke
