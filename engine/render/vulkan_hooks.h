#pragma once

#include <vulkan/vulkan_core.h>

namespace onestroke {

/// For runtimes that insist on creating Vulkan's objects (XR_KHR_vulkan_enable2). Each call behaves as its namesake in
/// Vulkan and may throw Error; `load` is the Vulkan loader's way in.
class VulkanHooks {
 public:
  virtual ~VulkanHooks() = default;
  virtual VkInstance create_instance(PFN_vkGetInstanceProcAddr load, const VkInstanceCreateInfo& info) = 0;
  virtual VkPhysicalDevice choose_device(VkInstance instance) = 0;
  virtual VkDevice create_device(PFN_vkGetInstanceProcAddr load, VkPhysicalDevice device,
                                 const VkDeviceCreateInfo& info) = 0;
};

}  // namespace onestroke
