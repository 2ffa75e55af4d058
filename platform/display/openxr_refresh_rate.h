#pragma once

#include "display/openxr_instance.h"

#include <optional>

namespace onestroke {

/// How often the headset shows another frame, where its runtime tells (XR_FB_display_refresh_rate).
class OpenXrRefreshRate {
 public:
  /// Asks for the highest that there is. Instance and session outlive this. Throws OpenXrError.
  OpenXrRefreshRate(const OpenXrInstance& instance, XrSession session);

  /// The rate is another now.
  void changed(const XrEventDataDisplayRefreshRateChangedFB& event) { hz_ = event.toDisplayRefreshRate; }
  /// From one frame on the screen to the next, ns; none where the runtime does not tell.
  std::optional<XrDuration> period() const;

 private:
  float hz_ = 0;
};

}  // namespace onestroke
