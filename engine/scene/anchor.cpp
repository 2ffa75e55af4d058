#include "scene/anchor.h"

#include "core/error.h"
#include "scene/frames.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace onestroke {

namespace {

// From the start arm's axis, whose rod has a radius of 3 mm, to the model's side.
constexpr double clear_of_arm = 8;

double reach_of(const Model& model, const Placement& placement) {
  const glm::vec3 pivot = point_to_graphics(placement.pivot);
  float farthest = 0;
  for (const ModelVertex& v : model.vertices) {
    const glm::vec4 at = placement.marker_graphics_from_model * glm::vec4(glm::make_vec3(v.position.data()), 1.0F);
    farthest = std::max(farthest, glm::distance(glm::vec3(at), pivot));
  }
  return farthest / metres_per_millimetre;
}

}  // namespace

Placement place_on_marker(const Model& model, std::optional<double> fit) {
  const glm::vec3 lower = glm::make_vec3(model.lower.data()), upper = glm::make_vec3(model.upper.data());
  const glm::vec3 extent = upper - lower;
  const float longest = std::max({extent.x, extent.y, extent.z});
  if (!(longest > 0)) throw Error("model " + model.name + ": it has no size; export it again");
  const double scale = fit ? *fit * metres_per_millimetre / double{longest} : 1;
  const auto millimetres = [&](float length) { return double{length} * scale / metres_per_millimetre; };
  Vec3 stand = anchor_stand;
  stand.x = std::max(stand.x, clear_of_arm + millimetres(extent.x) / 2);

  const glm::vec3 base((lower.x + upper.x) / 2, lower.y, (lower.z + upper.z) / 2);
  glm::mat4 m = glm::translate(glm::mat4(1.0F), point_to_graphics(stand));
  m = glm::scale(m, glm::vec3(static_cast<float>(scale)));
  m = glm::translate(m, -base);
  // Graphics and vision are half a turn about x apart.
  Placement placement{
      .marker_graphics_from_model = m,
      .marker_from_model = {{0, 1, 0, 0}, point_from_graphics(glm::vec3(m[3])), scale / metres_per_millimetre},
      .pivot = stand - Vec3{0, millimetres(extent.y) / 2, 0}};
  placement.reach = reach_of(model, placement);
  return placement;
}

}  // namespace onestroke
