// The fake runtime's graphics: Vulkan's objects as the program wants them, and images that nobody looks at.
#include "fake_runtime.h"

#include <array>
#include <deque>
#include <memory>
#include <vector>

namespace fake_runtime {
namespace {

constexpr std::uint32_t images_each = 3;

struct Graphics {
  PFN_vkGetInstanceProcAddr load = nullptr;
  bool asked = false;
  XrGraphicsBindingVulkan2KHR binding{};
};
Graphics graphics;

template <typename F>
F instance_function(VkInstance instance, const char* name) {
  return reinterpret_cast<F>(graphics.load(instance, name));
}

template <typename F>
F device_function(const char* name) {
  const auto get = instance_function<PFN_vkGetDeviceProcAddr>(graphics.binding.instance, "vkGetDeviceProcAddr");
  return reinterpret_cast<F>(get(graphics.binding.device, name));
}

XrResult get_requirements(XrInstance, XrSystemId, XrGraphicsRequirementsVulkanKHR* requirements) {
  graphics.asked = true;
  requirements->minApiVersionSupported = XR_MAKE_VERSION(1, 0, 0);
  requirements->maxApiVersionSupported = XR_MAKE_VERSION(1, 3, 0);
  return XR_SUCCESS;
}

XrResult create_vulkan_instance(XrInstance, const XrVulkanInstanceCreateInfoKHR* info, VkInstance* made,
                                VkResult* result) {
  graphics.load = info->pfnGetInstanceProcAddr;
  *result = instance_function<PFN_vkCreateInstance>(VK_NULL_HANDLE, "vkCreateInstance")(info->vulkanCreateInfo,
                                                                                        info->vulkanAllocator, made);
  return XR_SUCCESS;
}

XrResult get_device(XrInstance, const XrVulkanGraphicsDeviceGetInfoKHR* info, VkPhysicalDevice* device) {
  std::uint32_t one = 1;
  const auto list =
      instance_function<PFN_vkEnumeratePhysicalDevices>(info->vulkanInstance, "vkEnumeratePhysicalDevices");
  list(info->vulkanInstance, &one, device);
  graphics.binding.instance = info->vulkanInstance;
  return one == 1 ? XR_SUCCESS : XR_ERROR_RUNTIME_FAILURE;
}

XrResult create_device(XrInstance, const XrVulkanDeviceCreateInfoKHR* info, VkDevice* made, VkResult* result) {
  *result = instance_function<PFN_vkCreateDevice>(graphics.binding.instance, "vkCreateDevice")(
      info->vulkanPhysicalDevice, info->vulkanCreateInfo, info->vulkanAllocator, made);
  return XR_SUCCESS;
}

struct Swapchain {
  XrSwapchainCreateInfo info{};
  std::vector<VkImage> images;
  std::vector<VkDeviceMemory> memory;
  std::uint32_t next = 0;
  std::deque<std::uint32_t> acquired;  // the oldest first
  bool waited = false, released = false;
};
std::vector<std::unique_ptr<Swapchain>> swapchains;

Swapchain* find(XrSwapchain handle) {
  for (const auto& each : swapchains)
    if (reinterpret_cast<XrSwapchain>(each.get()) == handle) return each.get();
  violation("a swapchain that is not there", XR_ERROR_HANDLE_INVALID);
  return nullptr;
}

VkImageUsageFlags usage_of(XrSwapchainUsageFlags flags) {
  VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;
  if (flags & XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (flags & XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  if (flags & XR_SWAPCHAIN_USAGE_TRANSFER_SRC_BIT) usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  if (flags & XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT) usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return usage;
}

void add_image(Swapchain& swapchain) {
  const XrSwapchainCreateInfo& wanted = swapchain.info;
  const VkDevice device = graphics.binding.device;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = static_cast<VkFormat>(wanted.format);
  info.extent = {wanted.width, wanted.height, 1};
  info.mipLevels = wanted.mipCount;
  info.arrayLayers = wanted.arraySize;
  info.samples = static_cast<VkSampleCountFlagBits>(wanted.sampleCount);
  info.usage = usage_of(wanted.usageFlags);
  device_function<PFN_vkCreateImage>("vkCreateImage")(device, &info, nullptr, &swapchain.images.emplace_back());
  VkMemoryRequirements needs{};
  device_function<PFN_vkGetImageMemoryRequirements>("vkGetImageMemoryRequirements")(device, swapchain.images.back(),
                                                                                    &needs);
  std::uint32_t type = 0;
  while (!(needs.memoryTypeBits & 1U << type)) ++type;
  const VkMemoryAllocateInfo memory{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
  device_function<PFN_vkAllocateMemory>("vkAllocateMemory")(device, &memory, nullptr, &swapchain.memory.emplace_back());
  device_function<PFN_vkBindImageMemory>("vkBindImageMemory")(device, swapchain.images.back(), swapchain.memory.back(),
                                                              0);
}

XrResult enumerate_formats(XrSession, std::uint32_t capacity, std::uint32_t* count, std::int64_t* formats) {
  return give(std::array<std::int64_t, 2>{VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_B8G8R8A8_SRGB}, capacity, count, formats);
}

XrResult create_swapchain(XrSession, const XrSwapchainCreateInfo* info, XrSwapchain* made) {
  auto& swapchain = *swapchains.emplace_back(std::make_unique<Swapchain>());
  swapchain.info = *info;
  for (std::uint32_t i = 0; i < images_each; ++i) add_image(swapchain);
  *made = reinterpret_cast<XrSwapchain>(&swapchain);
  return XR_SUCCESS;
}

XrResult destroy_swapchain(XrSwapchain handle) {
  const Swapchain* swapchain = find(handle);
  if (!swapchain) return XR_ERROR_HANDLE_INVALID;
  for (std::uint32_t i = 0; i < images_each; ++i) {
    device_function<PFN_vkDestroyImage>("vkDestroyImage")(graphics.binding.device, swapchain->images[i], nullptr);
    device_function<PFN_vkFreeMemory>("vkFreeMemory")(graphics.binding.device, swapchain->memory[i], nullptr);
  }
  std::erase_if(swapchains, [&](const auto& each) { return each.get() == swapchain; });
  return XR_SUCCESS;
}

XrResult enumerate_images(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                          XrSwapchainImageBaseHeader* images) {
  const Swapchain* swapchain = find(handle);
  if (!swapchain) return XR_ERROR_HANDLE_INVALID;
  *count = images_each;
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < images_each) return XR_ERROR_SIZE_INSUFFICIENT;
  auto* each = reinterpret_cast<XrSwapchainImageVulkan2KHR*>(images);
  for (const VkImage image : swapchain->images) (each++)->image = image;
  return XR_SUCCESS;
}

XrResult acquire(XrSwapchain handle, const XrSwapchainImageAcquireInfo*, std::uint32_t* index) {
  Swapchain* swapchain = find(handle);
  if (!swapchain) return XR_ERROR_HANDLE_INVALID;
  if (swapchain->acquired.size() == images_each)
    return violation("more images acquired than there are", XR_ERROR_CALL_ORDER_INVALID);
  *index = swapchain->next;
  swapchain->next = (swapchain->next + 1) % images_each;
  swapchain->acquired.push_back(*index);
  return XR_SUCCESS;
}

XrResult wait(XrSwapchain handle, const XrSwapchainImageWaitInfo*) {
  Swapchain* swapchain = find(handle);
  if (!swapchain) return XR_ERROR_HANDLE_INVALID;
  if (swapchain->acquired.empty() || swapchain->waited)
    return violation("an image waited for that was not acquired", XR_ERROR_CALL_ORDER_INVALID);
  swapchain->waited = true;
  return XR_SUCCESS;
}

XrResult release(XrSwapchain handle, const XrSwapchainImageReleaseInfo*) {
  Swapchain* swapchain = find(handle);
  if (!swapchain) return XR_ERROR_HANDLE_INVALID;
  if (!swapchain->waited) return violation("an image released that was not waited for", XR_ERROR_CALL_ORDER_INVALID);
  swapchain->waited = false;
  swapchain->released = true;
  swapchain->acquired.pop_front();
  return XR_SUCCESS;
}

}  // namespace

void reset_graphics() {
  graphics = {};
  swapchains.clear();
}

bool requirements_asked() {
  return graphics.asked;
}

void use_graphics(const XrGraphicsBindingVulkan2KHR* binding) {
  if (!binding && !swapchains.empty()) violation("a session destroyed before its swapchains", XR_SUCCESS);
  graphics.binding = binding ? *binding : XrGraphicsBindingVulkan2KHR{};
}

bool can_show(const XrSwapchainSubImage& part) {
  const Swapchain* swapchain = find(part.swapchain);
  const XrRect2Di& rect = part.imageRect;
  return swapchain && swapchain->released && swapchain->acquired.empty() &&
         part.imageArrayIndex < swapchain->info.arraySize && rect.offset.x >= 0 && rect.offset.y >= 0 &&
         rect.offset.x + rect.extent.width <= static_cast<std::int32_t>(swapchain->info.width) &&
         rect.offset.y + rect.extent.height <= static_cast<std::int32_t>(swapchain->info.height);
}

PFN_xrVoidFunction graphics_function(std::string_view name) {
  static const std::array functions{named("xrGetVulkanGraphicsRequirements2KHR", get_requirements),
                                    named("xrCreateVulkanInstanceKHR", create_vulkan_instance),
                                    named("xrGetVulkanGraphicsDevice2KHR", get_device),
                                    named("xrCreateVulkanDeviceKHR", create_device),
                                    named("xrEnumerateSwapchainFormats", enumerate_formats),
                                    named("xrCreateSwapchain", create_swapchain),
                                    named("xrDestroySwapchain", destroy_swapchain),
                                    named("xrEnumerateSwapchainImages", enumerate_images),
                                    named("xrAcquireSwapchainImage", acquire),
                                    named("xrWaitSwapchainImage", wait),
                                    named("xrReleaseSwapchainImage", release)};
  return find(functions, name);
}

}  // namespace fake_runtime
