#pragma once

#include "display/openxr_instance.h"
#include "display/world_choice.h"

namespace onestroke {

/// Throws OpenXrError where the runtime does not say.
WorldOffers world_offers(const OpenXrInstance& instance);

/// How frames are blended where this is seen behind them.
XrEnvironmentBlendMode blend_mode_for(World world);

}  // namespace onestroke
