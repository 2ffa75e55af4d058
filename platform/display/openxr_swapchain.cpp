#include "display/openxr_swapchain.h"

#include <algorithm>
#include <array>

namespace onestroke {

namespace {

// A compositor that holds on to its images must not keep the program from hearing of its end.
constexpr XrDuration longest_wait_ns = 100'000'000;

/// The runtime's favourite among those that the renderer can draw in.
VkFormat choose_format(XrSession session) {
  constexpr const char* doing = "the OpenXR runtime does not say what images it takes: update it";
  std::uint32_t count = 0;
  check(xrEnumerateSwapchainFormats(session, 0, &count, nullptr), doing);
  std::vector<std::int64_t> offers(count);
  check(xrEnumerateSwapchainFormats(session, count, &count, offers.data()), doing);
  for (const std::int64_t offer : offers)
    if (offer == VK_FORMAT_R8G8B8A8_SRGB || offer == VK_FORMAT_B8G8R8A8_SRGB) return static_cast<VkFormat>(offer);
  throw Error("the OpenXR runtime takes no sRGB images of 8 bits: make another runtime active");
}

XrSwapchain create(XrSession session, VkFormat format, VkExtent2D size, bool copied) {
  auto info = typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | (copied ? XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT : 0);
  info.format = format;
  info.sampleCount = 1;
  info.width = size.width;
  info.height = size.height;
  info.faceCount = 1;
  info.arraySize = max_views;
  info.mipCount = 1;
  XrSwapchain swapchain = XR_NULL_HANDLE;
  check(xrCreateSwapchain(session, &info, &swapchain), "the OpenXR runtime has no images to draw in: restart it");
  return swapchain;
}

vk::raii::ImageView make_view(const Device& device, VkImage image, VkFormat format, std::uint32_t first,
                              std::uint32_t count) {
  return device.vk().createImageView({.image = image,
                                      .viewType = count == 1 ? vk::ImageViewType::e2D : vk::ImageViewType::e2DArray,
                                      .format = static_cast<vk::Format>(format),
                                      .subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                           .levelCount = 1,
                                                           .baseArrayLayer = first,
                                                           .layerCount = count}});
}

}  // namespace

OpenXrSwapchain::OpenXrSwapchain(const Device& device, XrSession session, VkExtent2D size, bool copied)
    : format_(choose_format(session)), size_(size), swapchain_(create(session, format_, size, copied)) {
  make_targets(device);
}

void OpenXrSwapchain::make_targets(const Device& device) {
  constexpr const char* doing = "the OpenXR runtime does not give its images: restart it";
  std::uint32_t count = 0;
  check(xrEnumerateSwapchainImages(*swapchain_, 0, &count, nullptr), doing);
  std::vector<XrSwapchainImageVulkan2KHR> images(
      count, typed<XrSwapchainImageVulkan2KHR>(XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR));
  check(xrEnumerateSwapchainImages(*swapchain_, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        doing);
  for (const auto& i : images) {
    RenderTarget target{.image = i.image,
                        .format = format_,
                        .width = static_cast<int>(size_.width),
                        .height = static_cast<int>(size_.height),
                        .layers = max_views};
    target.view = *views_.emplace_back(make_view(device, i.image, format_, 0, max_views));
    for (std::uint32_t eye = 0; eye < max_views; ++eye)
      target.layer_views.at(eye) = *views_.emplace_back(make_view(device, i.image, format_, eye, 1));
    targets_.push_back(target);
  }
}

const RenderTarget* OpenXrSwapchain::acquire() {
  if (!acquired_) {
    auto info = typed<XrSwapchainImageAcquireInfo>(XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
    check(xrAcquireSwapchainImage(*swapchain_, &info, &index_), "the OpenXR runtime has no image left to draw in");
    acquired_ = true;
    ready_ = false;
  }
  if (!ready_) {
    auto info = typed<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
    info.timeout = longest_wait_ns;
    ready_ =
        check(xrWaitSwapchainImage(*swapchain_, &info), "the OpenXR runtime keeps its images") != XR_TIMEOUT_EXPIRED;
  }
  return ready_ ? &targets_[index_] : nullptr;
}

void OpenXrSwapchain::release() {
  auto info = typed<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
  check(xrReleaseSwapchainImage(*swapchain_, &info), "the OpenXR runtime does not take a frame");
  acquired_ = false;
}

XrSwapchainSubImage OpenXrSwapchain::part_for(std::uint32_t eye) const {
  return {.swapchain = *swapchain_,
          .imageRect = {.offset = {0, 0},
                        .extent = {static_cast<std::int32_t>(size_.width), static_cast<std::int32_t>(size_.height)}},
          .imageArrayIndex = eye};
}

}  // namespace onestroke
