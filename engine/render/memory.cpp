#include "render/memory.h"

#include "core/error.h"

#include <algorithm>
#include <numeric>

namespace onestroke {

namespace {

constexpr std::uint64_t block_size = 32U << 20U;

std::uint64_t round_up(std::uint64_t value, std::uint64_t alignment) {
  return (value + alignment - 1) & ~(alignment - 1);
}

}  // namespace

std::optional<std::uint64_t> BlockSpace::take(std::uint64_t size, std::uint64_t alignment) {
  for (auto range = free_.begin(); range != free_.end(); ++range) {
    const std::uint64_t start = round_up(range->offset, alignment), end = range->offset + range->size;
    if (start + size > end) continue;
    const Range before{range->offset, start - range->offset}, after{start + size, end - start - size};
    auto next = free_.erase(range);
    if (after.size > 0) next = free_.insert(next, after);
    if (before.size > 0) free_.insert(next, before);
    return start;
  }
  return std::nullopt;
}

void BlockSpace::give_back(std::uint64_t offset, std::uint64_t size) {
  auto next = std::lower_bound(free_.begin(), free_.end(), offset,
                               [](const Range& range, std::uint64_t at) { return range.offset < at; });
  next = free_.insert(next, {offset, size});
  const auto join = [this](auto left) {
    const auto right = left + 1;
    if (right == free_.end() || left->offset + left->size != right->offset) return;
    left->size += right->size;
    free_.erase(right);
  };
  join(next);
  if (next != free_.begin()) join(next - 1);
}

std::uint64_t BlockSpace::free_bytes() const {
  return std::accumulate(free_.begin(), free_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Range& range) { return sum + range.size; });
}

struct MemoryPool::Block {
  vk::raii::DeviceMemory memory;
  std::uint64_t size;
  std::uint32_t type;
  std::byte* mapped;
  BlockSpace space;
};

Allocation::~Allocation() {
  if (pool_) pool_->release(*static_cast<MemoryPool::Block*>(block_), offset_, size_);
}

MemoryPool::MemoryPool(const vk::raii::Device& device, const vk::raii::PhysicalDevice& physical)
    : device_(device),
      properties_(physical.getMemoryProperties()),
      granularity_(physical.getProperties().limits.bufferImageGranularity) {}

MemoryPool::~MemoryPool() = default;

std::uint32_t MemoryPool::type_for(std::uint32_t allowed, Use use) const {
  using Flag = vk::MemoryPropertyFlagBits;
  const vk::MemoryPropertyFlags shared = Flag::eHostVisible | Flag::eHostCoherent;
  // Best first; the last of each list is what Vulkan promises.
  const std::array<vk::MemoryPropertyFlags, 2> wanted =
      use == Use::device     ? std::array{vk::MemoryPropertyFlags(Flag::eDeviceLocal), vk::MemoryPropertyFlags()}
      : use == Use::readback ? std::array{shared | Flag::eHostCached, shared}
                             : std::array{shared, shared};
  for (const auto flags : wanted)
    for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type)
      if ((allowed & (1U << type)) && (properties_.memoryTypes[type].propertyFlags & flags) == flags) return type;
  throw Error("the GPU has no memory of a kind that the renderer needs: choose another with --gpu");
}

MemoryPool::Block& MemoryPool::add_block(std::uint64_t size, std::uint32_t type, Use use) {
  try {
    auto memory = device_.allocateMemory({.allocationSize = size, .memoryTypeIndex = type});
    auto* mapped = use == Use::device ? nullptr : static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE));
    blocks_.push_back(std::make_unique<Block>(Block{std::move(memory), size, type, mapped, BlockSpace(size)}));
    return *blocks_.back();
  } catch (const vk::SystemError& error) {
    throw Error("the GPU has no room for another " + std::to_string(size >> 20U) +
                " MiB: close other programs or use smaller models (" + error.what() + ")");
  }
}

Allocation MemoryPool::allocate(const vk::MemoryRequirements& needs, Use use) {
  const std::uint32_t type = type_for(needs.memoryTypeBits, use);
  // Buffers and images share blocks, so each keeps to the granularity that stops them from aliasing.
  const std::uint64_t alignment = std::max(needs.alignment, granularity_);
  const std::uint64_t size = round_up(needs.size, granularity_);
  const bool mapped = use != Use::device;

  const std::lock_guard lock(mutex_);
  Block* home = nullptr;
  std::optional<std::uint64_t> offset;
  for (const auto& block : blocks_) {
    if (block->type != type || (block->mapped != nullptr) != mapped) continue;
    offset = block->space.take(size, alignment);
    if (offset) {
      home = block.get();
      break;
    }
  }
  if (!home) {
    home = &add_block(std::max(size, block_size), type, use);
    offset = home->space.take(size, alignment);
  }
  Allocation a;
  a.pool_ = this;
  a.block_ = home;
  a.memory_ = *home->memory;
  a.offset_ = *offset;
  a.size_ = size;
  a.mapped_ = home->mapped ? home->mapped + *offset : nullptr;
  return a;
}

void MemoryPool::release(Block& block, std::uint64_t offset, std::uint64_t size) noexcept {
  const std::lock_guard lock(mutex_);
  block.space.give_back(offset, size);
  if (block.size <= block_size || block.space.free_bytes() != block.size) return;
  // A block made for one large resource has no other use.
  std::erase_if(blocks_, [&block](const auto& held) { return held.get() == &block; });
}

}  // namespace onestroke
