#include "app/interrupt.h"

#include <atomic>
#include <csignal>

namespace onestroke {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void catch_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { asked.store(true, std::memory_order_relaxed); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
  return asked.load(std::memory_order_relaxed);
}

}  // namespace onestroke
