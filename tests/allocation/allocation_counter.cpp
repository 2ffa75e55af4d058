#include "allocation/allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

thread_local long own = 0;
std::atomic<long> all{0};

void* count_and_allocate(std::size_t size) {
  ++own;
  all.fetch_add(1, std::memory_order_relaxed);
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Kept out of line: a compiler that sees through them takes malloc and free for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  return count_and_allocate(size);
}
[[gnu::noinline]] void* operator new[](std::size_t size) {
  return count_and_allocate(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace onestroke::test {

long allocations_of_this_thread() {
  return own;
}
long allocations_of_all_threads() {
  return all.load();
}

}  // namespace onestroke::test
