#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace onestroke {

/// What is seen behind the models.
enum class World {
  automatic,    ///< What suits the display.
  camera,       ///< The camera's picture, which is drawn.
  alpha,        ///< The world itself, where and as far as nothing opaque is drawn.
  additive,     ///< The world itself, and what is drawn is light that is added.
  passthrough,  ///< The pictures of the display's own cameras, as alpha.
};

/// As the command line has them, in order.
inline constexpr std::array<std::string_view, 5> world_names{"auto", "camera", "alpha", "additive", "passthrough"};
constexpr std::string_view name_of(World world) {
  return world_names.at(static_cast<std::size_t>(world));
}

}  // namespace onestroke
