#pragma once

#include "core/time.h"
#include "display/openxr_instance.h"

namespace onestroke {

/// Between the runtime's clock, whose zero is its own affair, and ours.
class OpenXrClock {
 public:
  /// The instance outlives this. Throws OpenXrError.
  explicit OpenXrClock(const OpenXrInstance& instance);

  /// Neither allocates. Both throw OpenXrError where the runtime is gone.
  Time to_ours(XrTime time) const;
  XrTime to_runtime(Time time) const;

 private:
  XrInstance instance_;
  PFN_xrConvertTimeToTimespecTimeKHR to_timespec_;
  PFN_xrConvertTimespecTimeToTimeKHR from_timespec_;
};

}  // namespace onestroke
