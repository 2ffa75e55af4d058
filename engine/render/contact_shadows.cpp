#include "render/contact_shadows.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

// In reaches of the two together: a ball so far away covers less than a hundredth of the sky.
constexpr float too_far = 4;

}  // namespace

void ContactShadows::add(const ModelInstance& instance, std::span<const ContactBall> balls) {
  if (balls.empty() || count_ + balls.size() > balls_.size()) return;
  const glm::mat4 matrix = glm::make_mat4(instance.world_graphics_from_model.data());
  const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(matrix))));
  Caster caster{.instance = &instance, .balls = {static_cast<std::uint32_t>(count_), 0}};
  for (const ContactBall& ball : balls) {
    const glm::vec3 centre(matrix * glm::vec4(glm::make_vec3(ball.centre.data()), 1.0F));
    caster.centre += centre / static_cast<float>(balls.size());
    balls_[count_++] = gpu::vec4(centre, scale * ball.radius);
  }
  caster.balls.end = static_cast<std::uint32_t>(count_);
  for (std::size_t i = caster.balls.first; i < count_; ++i)
    caster.reach = std::max(caster.reach, glm::distance(glm::vec3(balls_[i]), caster.centre) + balls_[i].w);
  list_[casters_++] = caster;
}

BallRange ContactShadows::nearest_other(const ModelInstance& instance) const {
  const std::span casters(list_.data(), casters_);
  const auto self = std::ranges::find(casters, &instance, &Caster::instance);
  if (self == casters.end()) return {};
  BallRange found;
  float nearest = INFINITY;
  for (const Caster& other : casters) {
    const float distance = glm::distance(other.centre, self->centre);
    if (other.instance == &instance || distance >= nearest || distance > too_far * (self->reach + other.reach))
      continue;
    nearest = distance;
    found = other.balls;
  }
  return found;
}

}  // namespace onestroke
