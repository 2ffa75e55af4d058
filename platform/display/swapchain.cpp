#include "display/swapchain.h"

#include "core/error.h"

#include <algorithm>

namespace onestroke {

namespace {

vk::SurfaceFormatKHR choose_format(Device& device, vk::SurfaceKHR surface) {
  if (!device.physical().getSurfaceSupportKHR(device.queue_family(), surface))
    throw Error("GPU \"" + device.name() + "\" cannot show on this desktop: choose another with --gpu");
  for (const auto& offer : device.physical().getSurfaceFormatsKHR(surface))
    if (offer.format == vk::Format::eB8G8R8A8Srgb || offer.format == vk::Format::eR8G8B8A8Srgb) return offer;
  throw Error("this desktop offers no sRGB window to GPU \"" + device.name() + "\": choose another with --gpu");
}

vk::PresentModeKHR choose_mode(Device& device, vk::SurfaceKHR surface, SwapchainPace pace) {
  using Mode = vk::PresentModeKHR;
  const auto offers = device.physical().getSurfacePresentModesKHR(surface);
  const auto offered = [&](Mode mode) { return std::find(offers.begin(), offers.end(), mode) != offers.end(); };
  if (pace != SwapchainPace::screen && offered(Mode::eMailbox)) return Mode::eMailbox;
  if (pace != SwapchainPace::at_once) return Mode::eFifo;
  if (offered(Mode::eImmediate)) return Mode::eImmediate;
  throw Error("this desktop makes GPU \"" + device.name() + "\" wait for the screen: update its driver");
}

vk::ImageUsageFlags usage_of(const SwapchainOptions& options) {
  return vk::ImageUsageFlagBits::eColorAttachment |
         (options.copied_to ? vk::ImageUsageFlagBits::eTransferDst : vk::ImageUsageFlags());
}

// A desktop need not give images back of a window that it does not show; keys and the close button are heard all the
// same.
constexpr std::uint64_t longest_wait_ns = 100'000'000;

std::uint32_t between(int value, std::uint32_t low, std::uint32_t high) {
  return std::clamp(static_cast<std::uint32_t>(std::max(value, 0)), low, high);
}

}  // namespace

Swapchain::Swapchain(Device& device, vk::SurfaceKHR surface, const SwapchainOptions& options)
    : device_(device),
      surface_(surface),
      format_(choose_format(device, surface)),
      mode_(choose_mode(device, surface, options.pace)),
      usage_(usage_of(options)),
      longest_wait_ns_(options.pace == SwapchainPace::at_once ? 0 : longest_wait_ns),
      ready_{device.vk().createSemaphore({}), device.vk().createSemaphore({}), device.vk().createSemaphore({})} {}

bool Swapchain::rebuild(int width, int height) {
  const auto able = device_.physical().getSurfaceCapabilitiesKHR(surface_);
  vk::Extent2D extent = able.currentExtent;
  if (extent.width == UINT32_MAX)
    extent = vk::Extent2D{between(width, able.minImageExtent.width, able.maxImageExtent.width),
                          between(height, able.minImageExtent.height, able.maxImageExtent.height)};
  if (extent.width == 0 || extent.height == 0) return false;
  const std::uint32_t most = able.maxImageCount ? able.maxImageCount : UINT32_MAX;
  targets_.clear();
  views_.clear();
  swapchain_ = device_.vk().createSwapchainKHR({.surface = surface_,
                                                .minImageCount = std::min(able.minImageCount + 1, most),
                                                .imageFormat = format_.format,
                                                .imageColorSpace = format_.colorSpace,
                                                .imageExtent = extent,
                                                .imageArrayLayers = 1,
                                                .imageUsage = usage_,
                                                .preTransform = able.currentTransform,
                                                .compositeAlpha = vk::CompositeAlphaFlagBitsKHR::eOpaque,
                                                .presentMode = mode_,
                                                .clipped = true,
                                                .oldSwapchain = *swapchain_});
  make_targets(extent);
  return true;
}

void Swapchain::make_targets(vk::Extent2D extent) {
  for (const VkImage image : swapchain_.getImages()) {
    views_.push_back(device_.vk().createImageView(
        {.image = image,
         .viewType = vk::ImageViewType::e2D,
         .format = format_.format,
         .subresourceRange = {.aspectMask = vk::ImageAspectFlagBits::eColor, .levelCount = 1, .layerCount = 1}}));
    if (done_.size() < views_.size()) done_.push_back(device_.vk().createSemaphore({}));
    targets_.push_back({.image = image,
                        .view = *views_.back(),
                        .format = static_cast<VkFormat>(format_.format),
                        .width = static_cast<int>(extent.width),
                        .height = static_cast<int>(extent.height),
                        .final_layout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                        .done = *done_[views_.size() - 1]});
  }
}

const RenderTarget* Swapchain::acquire(Status& status) {
  // The plain call, since the wrapped one throws where the window has merely changed size.
  const vk::Semaphore ready = *ready_[next_ready_];
  const auto result = device_.vk().getDispatcher()->vkAcquireNextImageKHR(*device_.vk(), *swapchain_, longest_wait_ns_,
                                                                          ready, VK_NULL_HANDLE, &taken_);
  const bool none_yet = result == VK_TIMEOUT || result == VK_NOT_READY;
  status = result == VK_SUCCESS || none_yet ? Status::good : Status::stale;
  if (none_yet || result == VK_ERROR_OUT_OF_DATE_KHR) return nullptr;
  if (result != VK_SUCCESS && result != VK_SUBOPTIMAL_KHR)
    vk::throwResultException(static_cast<vk::Result>(result), "taking a picture of the window");
  next_ready_ = (next_ready_ + 1) % acquires;
  RenderTarget& target = targets_[taken_];
  target.ready = ready;
  return &target;
}

Swapchain::Status Swapchain::present() {
  const VkSwapchainKHR swapchain = *swapchain_;
  const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                              .pNext = nullptr,
                              .waitSemaphoreCount = 1,
                              .pWaitSemaphores = &targets_[taken_].done,
                              .swapchainCount = 1,
                              .pSwapchains = &swapchain,
                              .pImageIndices = &taken_,
                              .pResults = nullptr};
  const auto result = device_.vk().getDispatcher()->vkQueuePresentKHR(*device_.queue(), &info);
  if (result == VK_SUCCESS) return Status::good;
  if (result != VK_SUBOPTIMAL_KHR && result != VK_ERROR_OUT_OF_DATE_KHR)
    vk::throwResultException(static_cast<vk::Result>(result), "showing a picture in the window");
  return Status::stale;
}

}  // namespace onestroke
