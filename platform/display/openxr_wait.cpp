#include "display/openxr_wait.h"

#include "core/time.h"
#include "display/openxr_api.h"

#include <cstdio>
#include <string>
#include <thread>

namespace onestroke {

namespace {

constexpr Duration between_tries = Duration::from_seconds(1);
constexpr std::chrono::milliseconds between_looks(20);

bool pause(bool (*give_up)()) {
  for (const Time until = Time::now() + between_tries; Time::now() < until; std::this_thread::sleep_for(between_looks))
    if (give_up()) return false;
  return true;
}

}  // namespace

std::unique_ptr<Display> wait_for_headset(const OpenXrOptions& options, bool (*give_up)()) {
  for (std::string said;;) {
    try {
      return std::make_unique<OpenXrDisplay>(options);
    } catch (const OpenXrError& error) {
      if (said != error.what()) std::fprintf(stderr, "onestroke: waiting: %s\n", error.what());
      said = error.what();
      if (!pause(give_up)) throw;
    }
  }
}

}  // namespace onestroke
