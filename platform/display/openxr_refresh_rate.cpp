#include "display/openxr_refresh_rate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace onestroke {

OpenXrRefreshRate::OpenXrRefreshRate(const OpenXrInstance& instance, XrSession session) {
  if (!instance.has(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME)) return;
  constexpr const char* doing = "the headset does not say how often it shows a frame: update its runtime";
  const auto enumerate = instance.function<PFN_xrEnumerateDisplayRefreshRatesFB>("xrEnumerateDisplayRefreshRatesFB");
  std::uint32_t count = 0;
  check(enumerate(session, 0, &count, nullptr), doing);
  std::vector<float> rates(count);
  check(enumerate(session, count, &count, rates.data()), doing);
  // A rate that is not granted is no misfortune: another one is told below.
  if (!rates.empty())
    instance.function<PFN_xrRequestDisplayRefreshRateFB>("xrRequestDisplayRefreshRateFB")(session,
                                                                                          std::ranges::max(rates));
  check(instance.function<PFN_xrGetDisplayRefreshRateFB>("xrGetDisplayRefreshRateFB")(session, &hz_), doing);
}

std::optional<XrDuration> OpenXrRefreshRate::period() const {
  if (!(hz_ > 0)) return std::nullopt;
  return std::llround(1e9 / double{hz_});
}

}  // namespace onestroke
