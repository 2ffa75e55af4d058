#pragma once

#include "render/frame_scene.h"
#include "scene/contact_balls.h"
#include "shaders/shared.h"

#include <array>
#include <span>

namespace onestroke {

/// Balls of a frame's list: from `first` to before `end`.
struct BallRange {
  std::uint32_t first = 0, end = 0;
};

/// Which model takes light from which: each from the one nearest to it, where that is near enough to matter. No
/// allocation.
class ContactShadows {
 public:
  void clear() { count_ = casters_ = 0; }
  /// A model and the balls that stand for it. Models for whose balls there is no room any more cast no shadow.
  void add(const ModelInstance& instance, std::span<const ContactBall> balls);
  /// The balls of the nearest model but the instance itself; none where it is too far away to be seen in the light.
  BallRange nearest_other(const ModelInstance& instance) const;
  /// World, graphics axes, metres: centre, radius.
  std::span<const gpu::vec4> balls() const { return {balls_.data(), count_}; }

 private:
  struct Caster {
    const ModelInstance* instance = nullptr;
    BallRange balls;
    glm::vec3 centre{0};
    float reach = 0;
  };

  std::array<gpu::vec4, MOST_BALLS> balls_{};
  std::array<Caster, MOST_BALLS> list_{};
  std::size_t count_ = 0, casters_ = 0;
};

}  // namespace onestroke
