#include "render/gpu_survey.h"

#include "core/error.h"
#include "render/instance.h"

namespace onestroke {

namespace {

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

GpuSurvey::Device survey(const vk::raii::PhysicalDevice& device) {
  const vk::PhysicalDeviceProperties properties = device.getProperties();
  GpuSurvey::Device found{.name = properties.deviceName.data(),
                          .driver = std::to_string(properties.driverVersion),
                          .api = version_text(properties.apiVersion),
                          .lacking = shortfall(device, {})};
  if (properties.apiVersion >= VK_API_VERSION_1_2) {
    const auto more = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = more.get<vk::PhysicalDeviceDriverProperties>();
    found.driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data();
  }
  return found;
}

}  // namespace

GpuSurvey survey_gpus() {
  GpuSurvey found;
  try {
    const vk::raii::Context context = load_vulkan();
    found.loader = version_text(context.enumerateInstanceVersion());
    found.validation = has_validation(context);
    const vk::raii::Instance instance = create_instance(context, {});
    for (const vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance))
      found.devices.push_back(survey(device));
  } catch (const Error& error) {
    found.failure = error.what();
  } catch (const vk::Error& error) {
    found.failure = std::string("Vulkan does not say what there is: update the GPU's driver (") + error.what() + ")";
  }
  return found;
}

}  // namespace onestroke
