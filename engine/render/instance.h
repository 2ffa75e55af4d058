#pragma once

#include "render/gpu.h"
#include "render/vulkan.h"

namespace onestroke {

/// Loads Vulkan. Throws Error where its loader is missing.
vk::raii::Context load_vulkan();

/// Whether Khronos validation is installed.
bool has_validation(const vk::raii::Context& context);

vk::raii::Instance create_instance(const vk::raii::Context& context, const GpuOptions& options);

/// What hears validation after the instance is made; a null handle where validation is off.
vk::raii::DebugUtilsMessengerEXT create_messenger(const vk::raii::Instance& instance, const GpuOptions& options);

/// What keeps a device from being used, "it has no Vulkan 1.3"; empty where nothing does.
std::string shortfall(const vk::raii::PhysicalDevice& device, const GpuOptions& options);

/// The device that the options ask for. Throws Error where none has Vulkan 1.3 and what `needs` names.
vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance, const GpuOptions& options);

/// The first family of queues that draws, computes and copies. Throws Error where there is none.
std::uint32_t choose_queue_family(const vk::raii::PhysicalDevice& device);

vk::raii::Device create_device(const vk::raii::PhysicalDevice& physical, std::uint32_t queue_family,
                               const GpuOptions& options);

}  // namespace onestroke
