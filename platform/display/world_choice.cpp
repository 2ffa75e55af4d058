#include "display/world_choice.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace onestroke {

World choose_world(const WorldOffers& offers, World wish) {
  // By itself the first.
  const std::array ways{std::pair{World::camera, offers.opaque}, std::pair{World::alpha, offers.alpha},
                        std::pair{World::additive, offers.additive}, std::pair{World::passthrough, offers.passthrough}};
  const auto* found = std::ranges::find_if(
      ways, [wish](const auto& way) { return way.second && (wish == World::automatic || wish == way.first); });
  if (found != ways.end()) return found->first;
  std::string offered;
  for (const auto& [world, can] : ways)
    if (can) offered += (offered.empty() ? "" : " or ") + std::string(name_of(world));
  if (offered.empty()) throw Error("the headset does not say how it shows the world: update its runtime");
  throw Error("the headset does not offer --world " + std::string(name_of(wish)) + ": use --world " + offered);
}

}  // namespace onestroke
