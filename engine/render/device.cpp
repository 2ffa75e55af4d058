#include "render/device.h"

#include "render/instance.h"

namespace onestroke {

Device::Device(const GpuOptions& options)
    : rehearsal_(options.rehearsal),
      context_(load_vulkan()),
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

void Device::submit(const vk::SubmitInfo2& work, vk::Fence done) {
  if (rehearsal_ && rehearsal_->submissions > 0 && --rehearsal_->submissions == 0) lost_ = true;
  if (lost_) throw vk::DeviceLostError("rehearsed");
  queue_.submit2(work, done);
}

void Device::wait(vk::Fence done) const {
  if (lost_ && rehearsal_->work_too) throw vk::DeviceLostError("rehearsed");
  vk::resultCheck(device_.waitForFences(done, true, UINT64_MAX), "waiting for the GPU");
}

void Device::wait_idle() const noexcept {
  // The plain call: the wrapped one throws where the GPU is lost.
  device_.getDispatcher()->vkDeviceWaitIdle(*device_);
}

void Device::submit_and_wait(vk::CommandBuffer commands) {
  const vk::CommandBufferSubmitInfo buffer{.commandBuffer = commands};
  const vk::raii::Fence fence = device_.createFence({});
  submit({.commandBufferInfoCount = 1, .pCommandBufferInfos = &buffer}, *fence);
  wait(*fence);
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
