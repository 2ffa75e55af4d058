#include "render/device.h"

#include "core/error.h"
#include "render/instance.h"

namespace onestroke {

Device::Device(const GpuOptions& options)
    : context_(load_vulkan()),
      instance_(create_instance(context_, options)),
      messenger_(create_messenger(instance_, options)),
      physical_(choose_device(instance_, options)),
      properties_(physical_.getProperties()),
      queue_family_(choose_queue_family(physical_)),
      // A CPU pays for it by the texel.
      anisotropy_(physical_.getFeatures().samplerAnisotropy && properties_.deviceType != vk::PhysicalDeviceType::eCpu),
      device_(create_device(physical_, queue_family_, options)),
      queue_(device_, queue_family_, 0),
      memory_(device_, physical_),
      pipeline_cache_(device_, properties_, options.cache_folder) {}

std::string Device::name() const {
  const auto chain = physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  return std::string(properties_.deviceName.data()) + ", " +
         chain.get<vk::PhysicalDeviceDriverProperties>().driverInfo.data();
}

void Device::submit_and_wait(vk::CommandBuffer commands) {
  const vk::CommandBufferSubmitInfo buffer{.commandBuffer = commands};
  const vk::raii::Fence fence = device_.createFence({});
  queue_.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer}, *fence);
  if (device_.waitForFences(*fence, true, UINT64_MAX) != vk::Result::eSuccess)
    throw Error("the GPU did not finish its work: restart the program");
}

Gpu::Gpu(const GpuOptions& options) : device_(std::make_shared<Device>(options)) {}
Gpu::~Gpu() = default;
Gpu::Gpu(Gpu&&) noexcept = default;
Gpu& Gpu::operator=(Gpu&&) noexcept = default;

std::string Gpu::name() const {
  return device_->name();
}

void Gpu::wait() {
  device_->vk().waitIdle();
}

}  // namespace onestroke
