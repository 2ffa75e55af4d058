#pragma once

#include "core/time.h"

#include <semaphore.h>

#include <atomic>

namespace onestroke {

/// Lets one thread sleep until others have something for it.
class Waker {
 public:
  Waker() noexcept { sem_init(&semaphore_, 0, 0); }
  ~Waker() { sem_destroy(&semaphore_); }
  Waker(const Waker&) = delete;
  Waker& operator=(const Waker&) = delete;

  /// Ends a sleep, or the next one. What was written before is seen after it. Any thread; neither locks nor allocates.
  void wake() noexcept {
    if (!woken_.exchange(true, std::memory_order_acq_rel)) sem_post(&semaphore_);
  }
  /// The one thread: until somebody wakes it, or so long.
  void sleep(Duration most) noexcept;

 private:
  std::atomic<bool> woken_{false};
  sem_t semaphore_{};
};

}  // namespace onestroke
