#include "camera/waker.h"

#include <cerrno>
#include <ctime>

namespace onestroke {

void Waker::sleep(Duration most) noexcept {
  constexpr std::int64_t second = 1'000'000'000;
  const Time end = Time::now() + most;
  const timespec until{.tv_sec = end.ns / second, .tv_nsec = end.ns % second};
  int ended = 0;
  do ended = sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until);
  while (ended != 0 && errno == EINTR);
  if (ended == 0) woken_.exchange(false, std::memory_order_acq_rel);
}

}  // namespace onestroke
