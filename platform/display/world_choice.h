#pragma once

#include "render/world.h"

namespace onestroke {

/// How a headset can show the world.
struct WorldOffers {
  bool opaque = false;       ///< What is drawn covers the world.
  bool alpha = false;        ///< By the opacity of what is drawn.
  bool additive = false;     ///< Under the light of what is drawn.
  bool passthrough = false;  ///< As a layer of the headset's own cameras.
};

/// What the wearer will see: what was asked for, or by itself our camera's pictures, which every opaque headset can
/// show; else the world by alpha, or else additively. Throws Error, which names what is offered, where it is not
/// offered.
World choose_world(const WorldOffers& offers, World wish);

}  // namespace onestroke
