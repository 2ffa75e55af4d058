#pragma once

#include "display/openxr_instance.h"
#include "render/vulkan_hooks.h"

namespace onestroke {

/// Has the runtime create Vulkan's instance and device, with what it needs itself added (XR_KHR_vulkan_enable2).
class OpenXrVulkan final : public VulkanHooks {
 public:
  /// Before all else, and again where the instance was made anew, which must be there whenever a call comes.
  void use(const OpenXrInstance& instance) { instance_ = &instance; }

  VkInstance create_instance(PFN_vkGetInstanceProcAddr load, const VkInstanceCreateInfo& info) override;
  VkPhysicalDevice choose_device(VkInstance instance) override;
  VkDevice create_device(PFN_vkGetInstanceProcAddr load, VkPhysicalDevice device,
                         const VkDeviceCreateInfo& info) override;

 private:
  const OpenXrInstance* instance_ = nullptr;
};

}  // namespace onestroke
