#include "display/openxr_swapchain.h"

#include "scene/frames.h"

#include <array>
#include <limits>

namespace onestroke {

namespace {

constexpr std::array color_formats{VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB};
// Without a stencil, of which the compositor has no need.
constexpr std::array depth_formats{VK_FORMAT_D32_SFLOAT, VK_FORMAT_D16_UNORM};

OpenXrImages::Kind color_kind(XrSession session, VkExtent2D size, bool copied) {
  const VkFormat format = choose_format(session, color_formats);
  if (format == VK_FORMAT_UNDEFINED)
    throw Error("the OpenXR runtime takes no sRGB images of 8 bits: make another runtime active");
  return {.format = format,
          .size = size,
          .usage = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | (copied ? XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT : 0)};
}

/// Whether the device can draw depth in that format, and sample what it has drawn with several samples.
bool draws_depth(const Device& device, VkFormat format) {
  if (format == VK_FORMAT_UNDEFINED) return false;
  const auto has = device.physical().getFormatProperties(static_cast<vk::Format>(format));
  return (has.optimalTilingFeatures & vk::FormatFeatureFlagBits::eDepthStencilAttachment) &&
         (device.properties().limits.sampledImageDepthSampleCounts & vk::SampleCountFlagBits::e4);
}

}  // namespace

OpenXrSwapchain::OpenXrSwapchain(const Device& device, XrSession session, VkExtent2D size, Uses uses)
    : color_(device, session, color_kind(session, size, uses.copied)) {
  const VkFormat depth = uses.depth ? choose_format(session, depth_formats) : VK_FORMAT_UNDEFINED;
  if (draws_depth(device, depth))
    depth_.emplace(device, session,
                   OpenXrImages::Kind{.format = depth,
                                      .size = size,
                                      .usage = XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                      .aspect = vk::ImageAspectFlagBits::eDepth});
}

const RenderTarget* OpenXrSwapchain::acquire() {
  const OpenXrImages::Lent* color = color_.acquire();
  const OpenXrImages::Lent* depth = depth_ && color ? depth_->acquire() : nullptr;
  if (!color || (depth_ && !depth)) return nullptr;
  const OpenXrImages::Kind& kind = color_.kind();
  target_ = {.image = color->image,
             .view = color->view,
             .layer_views = color->layer_views,
             .format = kind.format,
             .width = static_cast<int>(kind.size.width),
             .height = static_cast<int>(kind.size.height),
             .layers = max_views};
  if (depth) target_.depth = {depth->image, depth->view, depth->layer_views, depth_->kind().format};
  return &target_;
}

void OpenXrSwapchain::release() {
  color_.release();
  if (depth_) depth_->release();
}

std::optional<XrCompositionLayerDepthInfoKHR> OpenXrSwapchain::depth_for(std::uint32_t eye) const {
  if (!depth_) return std::nullopt;
  auto info = typed<XrCompositionLayerDepthInfoKHR>(XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
  info.subImage = depth_->part_for(eye);
  info.minDepth = 0;
  info.maxDepth = 1;
  // Of the least and the greatest depth; reverse depth has the far end at 0.
  info.nearZ = std::numeric_limits<float>::infinity();
  info.farZ = static_cast<float>(near_plane * metres_per_millimetre);
  return info;
}

}  // namespace onestroke
