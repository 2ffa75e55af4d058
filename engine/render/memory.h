#pragma once

#include "render/vulkan.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace onestroke {

/// Which bytes of one block are free. First fit; neighbours are joined when they come back.
class BlockSpace {
 public:
  explicit BlockSpace(std::uint64_t size) : free_{{0, size}} {}
  /// The offset of `size` free bytes, a multiple of `alignment` (a power of two); nothing where none fits.
  std::optional<std::uint64_t> take(std::uint64_t size, std::uint64_t alignment);
  void give_back(std::uint64_t offset, std::uint64_t size);
  std::uint64_t free_bytes() const;

 private:
  struct Range {
    std::uint64_t offset, size;
  };
  std::vector<Range> free_;  // by offset, no two touching
};

class MemoryPool;

/// A piece of device memory; goes back to the pool by itself.
class Allocation {
 public:
  Allocation() = default;
  Allocation(Allocation&& o) noexcept { swap(o); }
  Allocation& operator=(Allocation&& o) noexcept {
    Allocation(std::move(o)).swap(*this);
    return *this;
  }
  ~Allocation();

  vk::DeviceMemory memory() const { return memory_; }
  std::uint64_t offset() const { return offset_; }
  /// Where the CPU sees it; null for memory of the device alone.
  std::byte* mapped() const { return mapped_; }

 private:
  friend class MemoryPool;
  void swap(Allocation& o) noexcept {
    std::swap(pool_, o.pool_);
    std::swap(block_, o.block_);
    std::swap(memory_, o.memory_);
    std::swap(offset_, o.offset_);
    std::swap(size_, o.size_);
    std::swap(mapped_, o.mapped_);
  }

  MemoryPool* pool_ = nullptr;
  void* block_ = nullptr;
  vk::DeviceMemory memory_;
  std::uint64_t offset_ = 0, size_ = 0;
  std::byte* mapped_ = nullptr;
};

/// Cuts resources out of large blocks, since drivers allow few allocations. Outlives its allocations. Any thread; a
/// frame that neither makes nor frees anything takes no lock.
class MemoryPool {
 public:
  enum class Use {
    device,    ///< the GPU alone
    upload,    ///< the CPU writes, the GPU reads
    readback,  ///< the GPU writes, the CPU reads
  };

  MemoryPool(const vk::raii::Device& device, const vk::raii::PhysicalDevice& physical);
  ~MemoryPool();

  /// Throws Error when the device is out of memory.
  Allocation allocate(const vk::MemoryRequirements& needs, Use use);

 private:
  friend class Allocation;
  struct Block;

  std::uint32_t type_for(std::uint32_t allowed, Use use) const;
  Block& add_block(std::uint64_t size, std::uint32_t type, Use use);
  void release(Block& block, std::uint64_t offset, std::uint64_t size) noexcept;

  const vk::raii::Device& device_;
  vk::PhysicalDeviceMemoryProperties properties_;
  std::uint64_t granularity_;
  std::mutex mutex_;  // for the blocks
  std::vector<std::unique_ptr<Block>> blocks_;
};

}  // namespace onestroke
