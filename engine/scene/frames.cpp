#include "scene/frames.h"

namespace onestroke {

namespace {

// F = diag(1, -1, -1), its own inverse.
constexpr std::array<double, 3> flip{1, -1, -1};

}  // namespace

glm::mat4 to_graphics(const Pose& T) {
  const Mat3 r = to_matrix(T.rotation);
  glm::mat4 m(1.0F);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      m[static_cast<glm::length_t>(column)][static_cast<glm::length_t>(row)] =
          static_cast<float>(flip[row] * r[row][column] * flip[column]);
  m[3] = glm::vec4(point_to_graphics(T.translation), 1.0F);
  return m;
}

Pose from_graphics(const glm::mat4& m) {
  Mat3 r{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      r[row][column] =
          flip[row] * double{m[static_cast<glm::length_t>(column)][static_cast<glm::length_t>(row)]} * flip[column];
  return {to_quat(r), point_from_graphics(glm::vec3(m[3]))};
}

Pose from_graphics(Quat r, Vec3 t) {
  return {normalized(Quat{r.w, flip[0] * r.x, flip[1] * r.y, flip[2] * r.z}),
          direction_from_graphics(t) / metres_per_millimetre};
}

Vec3 direction_from_graphics(Vec3 d) {
  return {flip[0] * d.x, flip[1] * d.y, flip[2] * d.z};
}

glm::vec3 point_to_graphics(Vec3 p) {
  return direction_to_graphics(metres_per_millimetre * p);
}

Vec3 point_from_graphics(const glm::vec3& p) {
  return direction_from_graphics(p) / metres_per_millimetre;
}

glm::vec3 direction_to_graphics(Vec3 d) {
  return {static_cast<float>(d.x), static_cast<float>(-d.y), static_cast<float>(-d.z)};
}

Vec3 direction_from_graphics(const glm::vec3& d) {
  return {double{d.x}, -double{d.y}, -double{d.z}};
}

}  // namespace onestroke
