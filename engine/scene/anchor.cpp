#include "scene/anchor.h"

#include "core/error.h"
#include "scene/frames.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace onestroke {

glm::mat4 marker_graphics_from_model(const Model& model, const Anchor& anchor) {
  const glm::vec3 lower = glm::make_vec3(model.lower.data()), upper = glm::make_vec3(model.upper.data());
  const glm::vec3 extent = upper - lower;
  const float longest = std::max({extent.x, extent.y, extent.z});
  if (!(longest > 0)) throw Error("model " + model.name + ": it has no size; export it again");
  const float scale = static_cast<float>(anchor.size * metres_per_millimetre) / longest;
  const glm::vec3 base((lower.x + upper.x) / 2, lower.y, (lower.z + upper.z) / 2);
  glm::mat4 m = glm::translate(glm::mat4(1.0F), point_to_graphics(anchor.stand));
  m = glm::scale(m, glm::vec3(scale));
  return glm::translate(m, -base);
}

}  // namespace onestroke
