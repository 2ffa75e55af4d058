#pragma once

#include "render/gpu.h"
#include "render/memory.h"
#include "render/pipeline_cache.h"
#include "render/vulkan.h"

namespace onestroke {

/// The insides of Gpu, for code that speaks Vulkan. Made in the order of its members.
class Device {
 public:
  explicit Device(const GpuOptions& options);
  Device(const Device&) = delete;

  const vk::raii::Instance& instance() const { return instance_; }
  const vk::raii::PhysicalDevice& physical() const { return physical_; }
  const vk::raii::Device& vk() const { return device_; }
  const vk::raii::Queue& queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }
  MemoryPool& memory() { return memory_; }
  /// For every pipeline that is made.
  const vk::raii::PipelineCache& pipeline_cache() const { return pipeline_cache_.vk(); }
  /// Limits and names.
  const vk::PhysicalDeviceProperties& properties() const { return properties_; }
  bool anisotropy() const { return anisotropy_; }
  std::string name() const;

  /// Hands work to the GPU; the fence, where one is given, tells when it is done. Throws vk::DeviceLostError where the
  /// GPU is lost.
  void submit(const vk::SubmitInfo2& work, vk::Fence done = {});
  /// Waits for a fence. Throws likewise.
  void wait(vk::Fence done) const;
  /// Waits until the GPU has nothing to do, which is at once where it is lost: before what it may use goes away.
  void wait_idle() const noexcept;

  /// Writes into the command buffer, submits it and waits: for loading, never for frames.
  template <typename Record>
  void run_now(Record&& record) {
    const vk::raii::CommandPool pool = device_.createCommandPool(
        {.flags = vk::CommandPoolCreateFlagBits::eTransient, .queueFamilyIndex = queue_family_});
    const vk::raii::CommandBuffer commands =
        std::move(device_.allocateCommandBuffers({.commandPool = *pool, .commandBufferCount = 1}).front());
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    commands.end();
    submit_and_wait(*commands);
  }

 private:
  void submit_and_wait(vk::CommandBuffer commands);

  LossRehearsal* rehearsal_;
  bool lost_ = false;  // in rehearsal
  vk::raii::Context context_;
  vk::raii::Instance instance_;
  vk::raii::DebugUtilsMessengerEXT messenger_;
  vk::raii::PhysicalDevice physical_;
  vk::PhysicalDeviceProperties properties_;
  std::uint32_t queue_family_;
  bool anisotropy_;
  vk::raii::Device device_;
  vk::raii::Queue queue_;
  MemoryPool memory_;
  PipelineCache pipeline_cache_;
};

}  // namespace onestroke
