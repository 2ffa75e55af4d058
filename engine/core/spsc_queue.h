#pragma once

#include "core/error.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace onestroke {

/// What two threads write is kept this many bytes apart, so that they do not slow each other down.
inline constexpr std::size_t cache_line = 64;

/// A bounded queue without locks between one producer thread and one consumer thread. It allocates when it is made and
/// never again, and no call waits.
template <typename T>
class SpscQueue {
  static_assert(std::is_nothrow_default_constructible_v<T> && std::is_nothrow_move_assignable_v<T>);

 public:
  /// Throws Error where the capacity is no power of two.
  explicit SpscQueue(std::size_t capacity) : mask_(capacity - 1) {
    if (!std::has_single_bit(capacity))
      throw Error("a queue's capacity must be a power of two, not " + std::to_string(capacity));
    slots_ = std::make_unique<T[]>(capacity);
  }

  /// Producer. False, counted as overflow, where the queue is full; the value is then left as it was.
  bool push(const T& value) {
    return push_with([&](T& slot) { slot = value; });
  }
  bool push(T&& value) {
    return push_with([&](T& slot) { slot = std::move(value); });
  }
  /// Producer. As push, for what is large: write(T&) fills the slot in place; it finds there what was pushed some
  /// rounds ago, or a default T. Not called where the queue is full.
  template <typename Write>
  bool push_with(Write&& write) {
    const std::uint64_t at = written_.load(std::memory_order_relaxed);
    if (at - read_seen_ > mask_) {
      read_seen_ = read_.load(std::memory_order_acquire);
      if (at - read_seen_ > mask_) {
        overflow_.fetch_add(1, std::memory_order_relaxed);
        return false;
      }
    }
    std::forward<Write>(write)(slots_[at & mask_]);
    written_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// Consumer. Calls take(T&) for everything that was there when the call began, `limit` at most, oldest first, and
  /// returns how many.
  /// Each slot is free again as soon as its call returns; what owns something is destroyed there unless take moved it
  /// away.
  template <typename Take>
  std::size_t drain(Take&& take, std::size_t limit = std::numeric_limits<std::size_t>::max()) {
    const std::uint64_t begin = read_.load(std::memory_order_relaxed);
    const std::uint64_t end = begin + std::min<std::uint64_t>(limit, written_.load(std::memory_order_acquire) - begin);
    for (std::uint64_t at = begin; at != end; ++at) {
      T& slot = slots_[at & mask_];
      take(slot);
      if constexpr (!std::is_trivially_copyable_v<T>) slot = T{};
      read_.store(at + 1, std::memory_order_release);
    }
    return static_cast<std::size_t>(end - begin);
  }

  /// Any thread: how many pushes found the queue full.
  std::uint64_t overflow() const { return overflow_.load(std::memory_order_relaxed); }
  std::size_t capacity() const { return static_cast<std::size_t>(mask_) + 1; }

 private:
  std::unique_ptr<T[]> slots_;
  const std::uint64_t mask_;
  alignas(cache_line) std::atomic<std::uint64_t> written_{0};
  std::uint64_t read_seen_ = 0;  // the producer's own copy of read_, refreshed only when the queue looks full
  std::atomic<std::uint64_t> overflow_{0};
  alignas(cache_line) std::atomic<std::uint64_t> read_{0};
};

}  // namespace onestroke
