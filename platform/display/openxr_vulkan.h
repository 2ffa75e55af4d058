#pragma once

#include "display/openxr_instance.h"
#include "render/vulkan_hooks.h"

namespace onestroke {

/// Has the runtime create Vulkan's instance and device, with what it needs itself added (XR_KHR_vulkan_enable2).
class OpenXrVulkan final : public VulkanHooks {
 public:
  /// Before all else, and again where the instance was made anew, which must be there whenever a call comes.
  void use(const OpenXrInstance& instance) { instance_ = &instance; }
  /// Before create_device(): the device shall be able to show in windows too, where its driver lets it.
  void want_windows() { windows_wanted_ = true; }
  /// Whether the device that was created last is.
  bool shows_windows() const { return shows_windows_; }

  VkInstance create_instance(PFN_vkGetInstanceProcAddr load, const VkInstanceCreateInfo& info) override;
  VkPhysicalDevice choose_device(VkInstance instance) override;
  VkDevice create_device(PFN_vkGetInstanceProcAddr load, VkPhysicalDevice device,
                         const VkDeviceCreateInfo& info) override;

 private:
  const OpenXrInstance* instance_ = nullptr;
  VkInstance vulkan_ = VK_NULL_HANDLE;
  bool windows_wanted_ = false, shows_windows_ = false;
};

}  // namespace onestroke
