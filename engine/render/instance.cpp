#include "render/instance.h"

#include "core/error.h"
#include "render/vulkan_hooks.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace onestroke {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL hear(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* said, void* messages) {
  if (messages) static_cast<std::atomic<int>*>(messages)->fetch_add(1, std::memory_order_relaxed);
  std::fprintf(stderr, "vulkan validation: %s\n", said->pMessage);
  return VK_FALSE;
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(const GpuOptions& options) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {.messageSeverity = Severity::eWarning | Severity::eError,
          .messageType = Type::eValidation | Type::ePerformance,
          .pfnUserCallback = hear,
          .pUserData = options.validation_messages};
}

void check_layer(const vk::raii::Context& context) {
  if (!has_validation(context))
    throw Error(std::string(validation_layer) + " is not installed: apt install vulkan-validationlayers");
}

void check_extensions(const vk::raii::Context& context, const std::vector<std::string>& wanted) {
  const auto there = context.enumerateInstanceExtensionProperties();
  for (const auto& name : wanted)
    if (std::none_of(there.begin(), there.end(), [&name](const auto& e) { return name == e.extensionName.data(); }))
      throw Error("Vulkan lacks the instance extension " + name +
                  ": apt install mesa-vulkan-drivers or the GPU's driver");
}

}  // namespace

vk::raii::Context load_vulkan() {
  try {
    return vk::raii::Context();
  } catch (const std::exception&) {
    throw Error("Vulkan's loader libvulkan.so.1 is missing: apt install libvulkan1 mesa-vulkan-drivers");
  }
}

bool has_validation(const vk::raii::Context& context) {
  const auto layers = context.enumerateInstanceLayerProperties();
  return std::any_of(layers.begin(), layers.end(),
                     [](const auto& layer) { return std::strcmp(layer.layerName, validation_layer) == 0; });
}

vk::raii::Instance create_instance(const vk::raii::Context& context, const GpuOptions& options) {
  check_extensions(context, options.needs.instance_extensions);
  std::vector<const char*> extensions, layers;
  for (const auto& name : options.needs.instance_extensions) extensions.push_back(name.c_str());
  auto listen = messenger_info(options);
  const auto feature = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  const vk::ValidationFeaturesEXT features{
      .pNext = &listen, .enabledValidationFeatureCount = 1, .pEnabledValidationFeatures = &feature};
  if (options.validation) {
    check_layer(context);
    layers.push_back(validation_layer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  const vk::ApplicationInfo application{.pApplicationName = "onestroke", .apiVersion = VK_API_VERSION_1_3};
  const vk::InstanceCreateInfo info{.pNext = options.validation ? &features : nullptr,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
                                    .ppEnabledLayerNames = layers.data(),
                                    .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                    .ppEnabledExtensionNames = extensions.data()};
  try {
    if (options.needs.hooks)
      return {context, options.needs.hooks->create_instance(context.getDispatcher()->vkGetInstanceProcAddr, info)};
    return context.createInstance(info);
  } catch (const vk::SystemError& error) {
    throw Error(std::string("no Vulkan driver works here: apt install mesa-vulkan-drivers or the GPU's driver (") +
                error.what() + ")");
  }
}

vk::raii::DebugUtilsMessengerEXT create_messenger(const vk::raii::Instance& instance, const GpuOptions& options) {
  if (!options.validation) return nullptr;
  return instance.createDebugUtilsMessengerEXT(messenger_info(options));
}

}  // namespace onestroke
