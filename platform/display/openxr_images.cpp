#include "display/openxr_images.h"

#include <algorithm>

namespace onestroke {

namespace {

// A compositor that holds on to its images must not keep the program from hearing of its end.
constexpr XrDuration longest_wait_ns = 100'000'000;

XrSwapchain create(XrSession session, const OpenXrImages::Kind& kind) {
  auto info = typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  info.usageFlags = kind.usage;
  info.format = kind.format;
  info.sampleCount = 1;
  info.width = kind.size.width;
  info.height = kind.size.height;
  info.faceCount = 1;
  info.arraySize = max_views;
  info.mipCount = 1;
  XrSwapchain swapchain = XR_NULL_HANDLE;
  check(xrCreateSwapchain(session, &info, &swapchain), "the OpenXR runtime has no images to draw in: restart it");
  return swapchain;
}

vk::raii::ImageView make_view(const Device& device, VkImage image, const OpenXrImages::Kind& kind, std::uint32_t first,
                              std::uint32_t count) {
  return device.vk().createImageView(
      {.image = image,
       .viewType = count == 1 ? vk::ImageViewType::e2D : vk::ImageViewType::e2DArray,
       .format = static_cast<vk::Format>(kind.format),
       .subresourceRange = {.aspectMask = kind.aspect, .levelCount = 1, .baseArrayLayer = first, .layerCount = count}});
}

}  // namespace

VkFormat choose_format(XrSession session, std::span<const VkFormat> usable) {
  constexpr const char* doing = "the OpenXR runtime does not say what images it takes: update it";
  std::uint32_t count = 0;
  check(xrEnumerateSwapchainFormats(session, 0, &count, nullptr), doing);
  std::vector<std::int64_t> offers(count);
  check(xrEnumerateSwapchainFormats(session, count, &count, offers.data()), doing);
  for (const std::int64_t offer : offers)
    if (std::ranges::find(usable, static_cast<VkFormat>(offer)) != usable.end()) return static_cast<VkFormat>(offer);
  return VK_FORMAT_UNDEFINED;
}

OpenXrImages::OpenXrImages(const Device& device, XrSession session, const Kind& kind)
    : kind_(kind), swapchain_(create(session, kind)) {
  take_images(device);
}

void OpenXrImages::take_images(const Device& device) {
  constexpr const char* doing = "the OpenXR runtime does not give its images: restart it";
  std::uint32_t count = 0;
  check(xrEnumerateSwapchainImages(*swapchain_, 0, &count, nullptr), doing);
  std::vector<XrSwapchainImageVulkan2KHR> images(
      count, typed<XrSwapchainImageVulkan2KHR>(XR_TYPE_SWAPCHAIN_IMAGE_VULKAN2_KHR));
  check(xrEnumerateSwapchainImages(*swapchain_, count, &count,
                                   reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        doing);
  for (const auto& i : images) {
    Lent lent{.image = i.image};
    lent.view = *views_.emplace_back(make_view(device, i.image, kind_, 0, max_views));
    for (std::uint32_t eye = 0; eye < max_views; ++eye)
      lent.layer_views.at(eye) = *views_.emplace_back(make_view(device, i.image, kind_, eye, 1));
    images_.push_back(lent);
  }
}

const OpenXrImages::Lent* OpenXrImages::acquire() {
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
  return ready_ ? &images_[index_] : nullptr;
}

void OpenXrImages::release() {
  auto info = typed<XrSwapchainImageReleaseInfo>(XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
  check(xrReleaseSwapchainImage(*swapchain_, &info), "the OpenXR runtime does not take a frame");
  acquired_ = false;
}

XrSwapchainSubImage OpenXrImages::part_for(std::uint32_t eye) const {
  return {.swapchain = *swapchain_,
          .imageRect = {.offset = {0, 0},
                        .extent = {static_cast<std::int32_t>(kind_.size.width),
                                   static_cast<std::int32_t>(kind_.size.height)}},
          .imageArrayIndex = eye};
}

}  // namespace onestroke
