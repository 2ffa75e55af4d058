#include "display/openxr_vulkan.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace onestroke {

namespace {

void check_vulkan(VkResult result, const std::string& what) {
  if (result != VK_SUCCESS)
    throw Error(what + " for the headset: update the GPU's driver (VkResult " + std::to_string(result) + ")");
}

bool offers(PFN_vkGetInstanceProcAddr load, VkInstance instance, VkPhysicalDevice device, std::string_view extension) {
  const auto list = reinterpret_cast<PFN_vkEnumerateDeviceExtensionProperties>(
      load(instance, "vkEnumerateDeviceExtensionProperties"));
  std::uint32_t count = 0;
  if (!list || list(device, nullptr, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> properties(count);
  if (list(device, nullptr, &count, properties.data()) != VK_SUCCESS) return false;
  return std::ranges::any_of(properties, [&](const auto& p) { return extension == p.extensionName; });
}

}  // namespace

VkInstance OpenXrVulkan::create_instance(PFN_vkGetInstanceProcAddr load, const VkInstanceCreateInfo& info) {
  // The runtime insists on being asked before a session is made.
  auto wanted = typed<XrGraphicsRequirementsVulkan2KHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR);
  check(instance_->function<PFN_xrGetVulkanGraphicsRequirements2KHR>("xrGetVulkanGraphicsRequirements2KHR")(
            instance_->handle(), instance_->headset(), &wanted),
        "the OpenXR runtime does not say which Vulkan it wants: update it");
  if (wanted.minApiVersionSupported > XR_MAKE_VERSION(1, 3, 0xffffffff))
    throw Error("the OpenXR runtime wants a later Vulkan than 1.3: make another runtime active");
  auto create = typed<XrVulkanInstanceCreateInfoKHR>(XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR);
  create.systemId = instance_->headset();
  create.pfnGetInstanceProcAddr = load;
  create.vulkanCreateInfo = &info;
  VkInstance made = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;
  check(instance_->function<PFN_xrCreateVulkanInstanceKHR>("xrCreateVulkanInstanceKHR")(instance_->handle(), &create,
                                                                                        &made, &result),
        "the OpenXR runtime cannot start Vulkan: install the driver of the headset's GPU");
  check_vulkan(result, "Vulkan does not start");
  vulkan_ = made;
  return made;
}

VkPhysicalDevice OpenXrVulkan::choose_device(VkInstance instance) {
  auto get = typed<XrVulkanGraphicsDeviceGetInfoKHR>(XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR);
  get.systemId = instance_->headset();
  get.vulkanInstance = instance;
  VkPhysicalDevice device = VK_NULL_HANDLE;
  check(instance_->function<PFN_xrGetVulkanGraphicsDevice2KHR>("xrGetVulkanGraphicsDevice2KHR")(instance_->handle(),
                                                                                                &get, &device),
        "the OpenXR runtime names no GPU for the headset: install the GPU's driver");
  return device;
}

VkDevice OpenXrVulkan::create_device(PFN_vkGetInstanceProcAddr load, VkPhysicalDevice device,
                                     const VkDeviceCreateInfo& info) {
  std::vector<const char*> extensions(info.ppEnabledExtensionNames,
                                      info.ppEnabledExtensionNames + info.enabledExtensionCount);
  shows_windows_ = windows_wanted_ && offers(load, vulkan_, device, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  if (shows_windows_) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  VkDeviceCreateInfo more = info;
  more.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  more.ppEnabledExtensionNames = extensions.data();
  auto create = typed<XrVulkanDeviceCreateInfoKHR>(XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR);
  create.systemId = instance_->headset();
  create.pfnGetInstanceProcAddr = load;
  create.vulkanPhysicalDevice = device;
  create.vulkanCreateInfo = &more;
  VkDevice made = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;
  check(instance_->function<PFN_xrCreateVulkanDeviceKHR>("xrCreateVulkanDeviceKHR")(instance_->handle(), &create, &made,
                                                                                    &result),
        "the OpenXR runtime cannot start the GPU: update the GPU's driver");
  check_vulkan(result, "the GPU does not start");
  return made;
}

}  // namespace onestroke
