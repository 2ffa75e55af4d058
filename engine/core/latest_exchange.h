#pragma once

#include "core/spsc_queue.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace onestroke {

/// Hands the newest of something from one producer thread to one consumer thread, without locks or allocation. Handle
/// owns what it refers to and is empty when default-made (PictureHandle). What is still here at the end is released by
/// the destructor, when both threads are done.
template <typename Handle>
class LatestExchange {
  static_assert(std::is_nothrow_default_constructible_v<Handle> && std::is_nothrow_move_assignable_v<Handle>);

 public:
  /// Producer. Takes the place of what has not been taken, which is released here and counted as dropped.
  void publish(Handle handle) noexcept {
    slots_[back_].handle = std::move(handle);
    const std::uint8_t previous = middle_.exchange(static_cast<std::uint8_t>(back_ | fresh), std::memory_order_acq_rel);
    if (previous & fresh) dropped_.fetch_add(1, std::memory_order_relaxed);
    back_ = previous & index;
    slots_[back_].handle = Handle{};
  }

  /// Consumer. The newest that was published since the last call; empty where there is none.
  Handle take() noexcept {
    if (!(middle_.load(std::memory_order_relaxed) & fresh)) return {};
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index;
    return std::exchange(slots_[front_].handle, Handle{});
  }

  /// Any thread: how many were replaced before they were taken.
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::uint8_t index = 3, fresh = 4;

  // Each side owns one slot; the third lies in the middle, and its number changes hands in one exchange.
  struct alignas(cache_line) Slot {
    Handle handle;
  };
  std::array<Slot, 3> slots_;
  alignas(cache_line) std::atomic<std::uint8_t> middle_{1};
  alignas(cache_line) std::uint8_t back_ = 0;  // the producer's
  std::atomic<std::uint64_t> dropped_{0};
  alignas(cache_line) std::uint8_t front_ = 2;  // the consumer's
};

}  // namespace onestroke
