#include "render/frame_ring.h"

#include "render/target.h"

#include <algorithm>

namespace onestroke {

namespace {

constexpr std::uint64_t smallest_arena = 256U << 10U;

vk::raii::DescriptorPool make_descriptors(Device& device) {
  using Type = vk::DescriptorType;
  const std::array sizes{vk::DescriptorPoolSize{Type::eUniformBufferDynamic, frames_in_flight},
                         vk::DescriptorPoolSize{Type::eUniformBuffer, frames_in_flight},
                         vk::DescriptorPoolSize{Type::eStorageBuffer, frames_in_flight},
                         vk::DescriptorPoolSize{Type::eSampledImage, frames_in_flight},
                         vk::DescriptorPoolSize{Type::eCombinedImageSampler, 9 * frames_in_flight}};
  return device.vk().createDescriptorPool({.maxSets = frames_in_flight,
                                           .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
                                           .pPoolSizes = sizes.data()});
}

vk::raii::Semaphore make_timeline(Device& device) {
  const vk::SemaphoreTypeCreateInfo type{.semaphoreType = vk::SemaphoreType::eTimeline};
  return device.vk().createSemaphore({.pNext = &type});
}

}  // namespace

void Arena::begin(Device& device, std::uint64_t bytes) {
  used_ = 0;
  if (buffer_.size() >= bytes) return;
  buffer_ = Buffer(device, std::max(smallest_arena, bytes * 2),
                   vk::BufferUsageFlagBits::eUniformBuffer | vk::BufferUsageFlagBits::eStorageBuffer |
                       vk::BufferUsageFlagBits::eVertexBuffer | vk::BufferUsageFlagBits::eIndexBuffer,
                   MemoryPool::Use::upload);
}

FrameRing::FrameRing(Device& device, vk::DescriptorSetLayout set_layout)
    : device_(device), descriptors_(make_descriptors(device)), timeline_(make_timeline(device)) {
  for (auto& slot : slots_) {
    slot.pool = device.vk().createCommandPool(
        {.flags = vk::CommandPoolCreateFlagBits::eTransient, .queueFamilyIndex = device.queue_family()});
    slot.commands =
        std::move(device.vk().allocateCommandBuffers({.commandPool = *slot.pool, .commandBufferCount = 1}).front());
    // The set goes with its pool.
    slot.set = device.vk()
                   .allocateDescriptorSets(
                       {.descriptorPool = *descriptors_, .descriptorSetCount = 1, .pSetLayouts = &set_layout})
                   .front()
                   .release();
  }
}

FrameRing::~FrameRing() {
  device_.wait_idle();
}

FrameSlot& FrameRing::begin() {
  index_ = (index_ + 1) % frames_in_flight;
  FrameSlot& slot = slots_[index_];
  const vk::SemaphoreWaitInfo wait{.semaphoreCount = 1, .pSemaphores = &*timeline_, .pValues = &slot.done_at};
  const auto result = device_.vk().waitSemaphores(wait, UINT64_MAX);
  vk::resultCheck(result, "waiting for a frame");
  slot.graveyard.clear();
  slot.pool.reset();
  slot.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  return slot;
}

void FrameRing::submit(const RenderTarget& target) {
  FrameSlot& slot = slots_[index_];
  slot.commands.end();
  const std::uint64_t done_at = frames_ + 1;
  const vk::CommandBufferSubmitInfo commands{.commandBuffer = *slot.commands};
  const vk::SemaphoreSubmitInfo wait{.semaphore = target.ready,
                                     .stageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput};
  const std::array signals{
      vk::SemaphoreSubmitInfo{
          .semaphore = *timeline_, .value = done_at, .stageMask = vk::PipelineStageFlagBits2::eAllCommands},
      vk::SemaphoreSubmitInfo{.semaphore = target.done, .stageMask = vk::PipelineStageFlagBits2::eAllCommands}};
  device_.submit({.waitSemaphoreInfoCount = target.ready ? 1U : 0U,
                  .pWaitSemaphoreInfos = &wait,
                  .commandBufferInfoCount = 1,
                  .pCommandBufferInfos = &commands,
                  .signalSemaphoreInfoCount = target.done ? 2U : 1U,
                  .pSignalSemaphoreInfos = signals.data()});
  // What was refused will never be done, and must not be waited for.
  slot.done_at = frames_ = done_at;
}

}  // namespace onestroke
