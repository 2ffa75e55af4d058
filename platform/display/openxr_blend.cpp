#include "display/openxr_blend.h"

#include "display/openxr_passthrough.h"

#include <algorithm>
#include <vector>

namespace onestroke {

WorldOffers world_offers(const OpenXrInstance& instance) {
  constexpr auto view_kind = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  constexpr const char* doing = "the headset does not say how it shows the world: update its runtime";
  std::uint32_t count = 0;
  check(xrEnumerateEnvironmentBlendModes(instance.handle(), instance.headset(), view_kind, 0, &count, nullptr), doing);
  std::vector<XrEnvironmentBlendMode> modes(count);
  check(xrEnumerateEnvironmentBlendModes(instance.handle(), instance.headset(), view_kind, count, &count, modes.data()),
        doing);
  const auto has = [&modes](XrEnvironmentBlendMode mode) { return std::ranges::find(modes, mode) != modes.end(); };
  WorldOffers offers{.opaque = has(XR_ENVIRONMENT_BLEND_MODE_OPAQUE),
                     .alpha = has(XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND),
                     .additive = has(XR_ENVIRONMENT_BLEND_MODE_ADDITIVE)};
  offers.passthrough = offers.opaque && OpenXrPassthrough::offered(instance);
  return offers;
}

XrEnvironmentBlendMode blend_mode_for(World world) {
  if (world == World::alpha) return XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND;
  if (world == World::additive) return XR_ENVIRONMENT_BLEND_MODE_ADDITIVE;
  return XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
}

}  // namespace onestroke
