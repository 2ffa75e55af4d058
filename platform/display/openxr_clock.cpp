#include "display/openxr_clock.h"

namespace onestroke {

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr const char* failure = "the OpenXR runtime's clock cannot be read";

}  // namespace

OpenXrClock::OpenXrClock(const OpenXrInstance& instance)
    : instance_(instance.handle()),
      to_timespec_(instance.function<PFN_xrConvertTimeToTimespecTimeKHR>("xrConvertTimeToTimespecTimeKHR")),
      from_timespec_(instance.function<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR")) {}

Time OpenXrClock::to_ours(XrTime time) const {
  timespec converted{};
  check(to_timespec_(instance_, time, &converted), failure);
  return {std::int64_t{converted.tv_sec} * second_ns + converted.tv_nsec};
}

XrTime OpenXrClock::to_runtime(Time time) const {
  const timespec ours{.tv_sec = time.ns / second_ns, .tv_nsec = time.ns % second_ns};
  XrTime converted = 0;
  check(from_timespec_(instance_, &ours, &converted), failure);
  return converted;
}

}  // namespace onestroke
