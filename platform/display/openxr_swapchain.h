#pragma once

#include "display/openxr_images.h"
#include "render/target.h"

#include <optional>

namespace onestroke {

/// The images that the runtime shows in turn, and those that say how far away what they show is: a layer for each eye,
/// all of one size.
class OpenXrSwapchain {
 public:
  struct Uses {
    bool copied = false;  ///< Images are copied from, too.
    bool depth = false;   ///< The runtime takes depth (XR_KHR_composition_layer_depth); left out where no format fits.
  };
  /// Session and device outlive this. Throws Error where the runtime takes no sRGB image.
  OpenXrSwapchain(const Device& device, XrSession session, VkExtent2D size, Uses uses);

  /// The next image, once the compositor has done with it; null where that takes too long, and the next call waits on.
  /// What was acquired and not released is given again. Throws OpenXrError.
  const RenderTarget* acquire();
  /// Hands the acquired image, drawn, to the runtime. Throws OpenXrError.
  void release();

  /// What a layer shows to one eye.
  XrSwapchainSubImage part_for(std::uint32_t eye) const { return color_.part_for(eye); }
  /// How far away that is; none where there is no depth.
  std::optional<XrCompositionLayerDepthInfoKHR> depth_for(std::uint32_t eye) const;

 private:
  OpenXrImages color_;
  std::optional<OpenXrImages> depth_;
  RenderTarget target_;
};

}  // namespace onestroke
