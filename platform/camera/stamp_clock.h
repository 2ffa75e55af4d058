#pragma once

#include "camera/capture.h"
#include "core/picture.h"

#include <string>

namespace onestroke {

/// What the clocks show at one moment.
struct ClockReading {
  Time monotonic;
  std::int64_t boot_ns = 0, real_ns = 0;

  static ClockReading now();
};

/// Finds out by which clock a driver stamps its pictures, and brings its stamps to CLOCK_MONOTONIC. The clock is the
/// one by which the first pictures arrive a little while after their stamps, the monotonic one where several do.
class StampClock {
 public:
  enum class Clock { unknown, monotonic, boot, real, none };

  /// The stamp on CLOCK_MONOTONIC; `now` is when the picture arrived. Where the clock is none of these it is that time.
  Time monotonic(std::int64_t stamp_ns, const ClockReading& now);
  Clock clock() const { return clock_; }
  /// For people: which clock it is, and how that is known. Once the first picture has come.
  std::string words() const;

 private:
  Clock clock_ = Clock::unknown;
  bool told_apart_ = false;  ///< By no other clock would it have done.
};

/// The light's time from the time of a driver's stamp. `offset` is how much later than by that reckoning it truly was.
Exposure exposure_of(Time stamp, StampMoment moment, Duration length, Duration readout, Duration offset);

}  // namespace onestroke
