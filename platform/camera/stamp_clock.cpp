#include "camera/stamp_clock.h"

#include <ctime>

namespace onestroke {
namespace {

// From the stamp to where it is read: the stamp may be that of an exposure's start, and the computer be busy. No stamp
// lies in the future by more than rounding.
constexpr Duration longest_age = Duration::from_seconds(3), rounding = Duration::from_ms(-1);

std::int64_t read_clock(clockid_t id) {
  timespec t{};
  clock_gettime(id, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

bool plausible(std::int64_t stamp_ns, std::int64_t now_ns) {
  const Duration age{now_ns - stamp_ns};
  return age >= rounding && age <= longest_age;
}

}  // namespace

ClockReading ClockReading::now() {
  ClockReading reading;
  reading.real_ns = read_clock(CLOCK_REALTIME);
  reading.boot_ns = read_clock(CLOCK_BOOTTIME);
  reading.monotonic = Time::now();
  return reading;
}

Time StampClock::monotonic(std::int64_t stamp_ns, const ClockReading& now) {
  if (clock_ == Clock::unknown) {
    const bool monotonic = plausible(stamp_ns, now.monotonic.ns), boot = plausible(stamp_ns, now.boot_ns),
               real = plausible(stamp_ns, now.real_ns);
    clock_ = monotonic ? Clock::monotonic : boot ? Clock::boot : real ? Clock::real : Clock::none;
    told_apart_ = static_cast<int>(monotonic) + static_cast<int>(boot) + static_cast<int>(real) == 1;
  }
  switch (clock_) {
    case Clock::monotonic:
      return {stamp_ns};
    case Clock::boot:
      return {stamp_ns - (now.boot_ns - now.monotonic.ns)};
    case Clock::real:
      return {stamp_ns - (now.real_ns - now.monotonic.ns)};
    case Clock::unknown:
    case Clock::none:
      break;
  }
  return now.monotonic;
}

std::string StampClock::words() const {
  switch (clock_) {
    case Clock::monotonic:
      return told_apart_
                 ? "pictures are stamped by the monotonic clock"
                 : "pictures are stamped by the monotonic clock or by the time since boot, which are the same as "
                   "long as this computer has not slept";
    case Clock::boot:
      return "pictures are stamped by the time since boot, which counts sleep";
    case Clock::real:
      return "pictures are stamped by the time of day, which may be set while they come";
    case Clock::unknown:
    case Clock::none:
      break;
  }
  return "pictures are stamped by no clock of this computer, so they count from their arrival, which is late by an "
         "unknown and changing time";
}

Exposure exposure_of(Time stamp, StampMoment moment, Duration length, Duration readout, Duration offset) {
  // A row is read out as soon as it has gathered its light, and sent as soon as it is read.
  const Duration since_start = moment == StampMoment::exposure_start ? Duration{} : length;
  return {stamp - since_start + offset, length, readout};
}

}  // namespace onestroke
