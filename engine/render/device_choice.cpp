#include "core/error.h"
#include "core/lower_case.h"
#include "render/instance.h"
#include "render/vulkan_hooks.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace onestroke {

namespace {

int rank(const vk::raii::PhysicalDevice& device) {
  switch (device.getProperties().deviceType) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return 0;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return 1;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return 2;
    default:
      return 3;
  }
}

std::string list_of(const std::vector<vk::raii::PhysicalDevice>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i)
    text += (i ? ", " : "") + std::to_string(i) + " " + devices[i].getProperties().deviceName.data();
  return text;
}

/// By its number, or else the first whose name has the words in it, in capitals or not. Names have numbers in them too.
std::optional<std::size_t> find_named(const std::vector<vk::raii::PhysicalDevice>& devices, const std::string& wanted) {
  std::size_t index = 0;
  const auto* end = wanted.data() + wanted.size();
  if (const auto parsed = std::from_chars(wanted.data(), end, index); parsed.ec == std::errc{} && parsed.ptr == end)
    if (index < devices.size()) return index;
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (lower_case(devices[i].getProperties().deviceName.data()).find(lower_case(wanted)) != std::string::npos)
      return i;
  return std::nullopt;
}

const vk::raii::PhysicalDevice& choose_named(const std::vector<vk::raii::PhysicalDevice>& devices,
                                             const GpuOptions& options) {
  const std::string called = "no GPU is called \"" + options.gpu + "\": ";
  if (devices.empty()) throw Error(called + "there is none; install mesa-vulkan-drivers or the GPU's driver");
  const auto named = find_named(devices, options.gpu);
  if (!named) throw Error(called + "give --gpu a number or part of a name of " + list_of(devices));
  const std::string lacking = shortfall(devices[*named], options);
  if (!lacking.empty())
    throw Error("GPU \"" + options.gpu + "\" cannot be used, " + lacking + ": choose another of " + list_of(devices));
  return devices[*named];
}

/// The one that the headset hangs on. Another is of no use, even where it was asked for.
vk::raii::PhysicalDevice choose_hooked(const vk::raii::Instance& instance, const GpuOptions& options) {
  vk::raii::PhysicalDevice device(instance, options.needs.hooks->choose_device(*instance));
  const std::string name = device.getProperties().deviceName.data();
  const std::string lacking = shortfall(device, options);
  if (!lacking.empty())
    throw Error("GPU \"" + name + "\", which the headset hangs on, cannot be used, " + lacking + ": update its driver");
  if (options.gpu.empty()) return device;
  const auto devices = vk::raii::PhysicalDevices(instance);
  const auto named = find_named(devices, options.gpu);
  if (!named || *devices[*named] != *device)
    throw Error("the headset hangs on GPU \"" + name + "\", not on \"" + options.gpu + "\": leave out --gpu");
  return device;
}

}  // namespace

std::string shortfall(const vk::raii::PhysicalDevice& device, const GpuOptions& options) {
  if (device.getProperties().apiVersion < VK_API_VERSION_1_3) return "it has no Vulkan 1.3";
  const auto features = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                            vk::PhysicalDeviceVulkan13Features>();
  const auto& v13 = features.get<vk::PhysicalDeviceVulkan13Features>();
  if (!v13.dynamicRendering || !v13.synchronization2 || !v13.maintenance4)
    return "it lacks dynamic rendering, synchronization2 or maintenance4";
  if (!features.get<vk::PhysicalDeviceFeatures2>().features.shaderClipDistance) return "it lacks clip distances";
  const auto there = device.enumerateDeviceExtensionProperties();
  for (const auto& name : options.needs.device_extensions)
    if (std::none_of(there.begin(), there.end(), [&name](const auto& e) { return name == e.extensionName.data(); }))
      return "it lacks " + name;
  return {};
}

vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance, const GpuOptions& options) {
  if (options.needs.hooks) return choose_hooked(instance, options);
  auto devices = vk::raii::PhysicalDevices(instance);
  if (!options.gpu.empty()) return choose_named(devices, options);
  std::stable_sort(devices.begin(), devices.end(), [](const auto& a, const auto& b) { return rank(a) < rank(b); });
  std::string reasons;
  for (auto& device : devices) {
    const std::string lacking = shortfall(device, options);
    if (lacking.empty()) return std::move(device);
    reasons += std::string(reasons.empty() ? " (" : "; ") + device.getProperties().deviceName.data() + ": " + lacking;
  }
  if (!reasons.empty()) reasons += ")";
  throw Error("no Vulkan 1.3 device: install mesa-vulkan-drivers or the GPU's driver" + reasons);
}

std::uint32_t choose_queue_family(const vk::raii::PhysicalDevice& device) {
  const auto families = device.getQueueFamilyProperties();
  const vk::QueueFlags wanted = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
  for (std::uint32_t i = 0; i < families.size(); ++i)
    if ((families[i].queueFlags & wanted) == wanted) return i;
  throw Error("the GPU has no queue that both draws and computes: choose another with --gpu");
}

vk::raii::Device create_device(const vk::raii::PhysicalDevice& physical, std::uint32_t queue_family,
                               const GpuOptions& options) {
  const float priority = 1;
  const vk::DeviceQueueCreateInfo queue{
      .queueFamilyIndex = queue_family, .queueCount = 1, .pQueuePriorities = &priority};
  std::vector<const char*> extensions;
  for (const auto& name : options.needs.device_extensions) extensions.push_back(name.c_str());
  vk::PhysicalDeviceVulkan13Features v13{.synchronization2 = true, .dynamicRendering = true, .maintenance4 = true};
  // By itself, not among Vulkan 1.2's: Monado looks for it alone, and would ask for it again.
  vk::PhysicalDeviceTimelineSemaphoreFeatures timeline{.pNext = &v13, .timelineSemaphore = true};
  // Every Vulkan 1.1 device has multiview.
  vk::PhysicalDeviceVulkan11Features v11{.pNext = &timeline, .multiview = true};
  const vk::PhysicalDeviceFeatures2 features{
      .pNext = &v11,
      .features = {.samplerAnisotropy = physical.getFeatures().samplerAnisotropy, .shaderClipDistance = true}};
  const vk::DeviceCreateInfo info{.pNext = &features,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data()};
  try {
    if (options.needs.hooks)
      return {physical,
              options.needs.hooks->create_device(physical.getDispatcher()->vkGetInstanceProcAddr, *physical, info)};
    return physical.createDevice(info);
  } catch (const vk::SystemError& error) {
    throw Error(std::string("the GPU's driver refuses to start: update it or choose another with --gpu (") +
                error.what() + ")");
  }
}

}  // namespace onestroke
