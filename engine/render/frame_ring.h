#pragma once

#include "render/resources.h"

#include <array>

namespace onestroke {

struct RenderTarget;

/// Memory that the CPU writes anew each frame and the GPU reads. Cut from front to back.
class Arena {
 public:
  /// Empties it and makes room for `bytes`. The GPU must be done with it.
  void begin(Device& device, std::uint64_t bytes);
  /// Copies a value in; returns its offset, a multiple of `alignment`.
  template <typename T>
  std::uint64_t put(std::span<const T> items, std::uint64_t alignment = 16) {
    const std::uint64_t at = (used_ + alignment - 1) / alignment * alignment;
    if (!items.empty()) std::memcpy(buffer_.mapped() + at, items.data(), items.size_bytes());
    used_ = at + items.size_bytes();
    return at;
  }
  /// Writes over what lies at `at`, before the frame is handed to the GPU.
  template <typename T>
  void replace(std::uint64_t at, std::span<const T> items) {
    std::memcpy(buffer_.mapped() + at, items.data(), items.size_bytes());
  }
  vk::Buffer handle() const { return buffer_.handle(); }

 private:
  Buffer buffer_;
  std::uint64_t used_ = 0;
};

/// What one frame in flight owns.
struct FrameSlot {
  vk::raii::CommandPool pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  Arena arena;
  Graveyard graveyard;
  vk::DescriptorSet set;
  std::uint64_t done_at = 0;  // value of the ring's semaphore; 0 before the first use
};

inline constexpr std::size_t frames_in_flight = 2;

/// The frames in flight, taken in turn.
class FrameRing {
 public:
  FrameRing(Device& device, vk::DescriptorSetLayout set_layout);
  /// Waits for the GPU to be done with all of them.
  ~FrameRing();

  /// Waits for the oldest frame, frees what it buried and opens its command buffer.
  FrameSlot& begin();
  /// Closes the current frame's commands and hands them to the GPU.
  void submit(const RenderTarget& target);
  /// The slot that begin() opened last: what is buried there outlives every frame submitted so far.
  FrameSlot& current() { return slots_[index_]; }

 private:
  Device& device_;
  vk::raii::DescriptorPool descriptors_;
  vk::raii::Semaphore timeline_;
  std::array<FrameSlot, frames_in_flight> slots_;
  std::size_t index_ = 0;
  std::uint64_t frames_ = 0;
};

}  // namespace onestroke
