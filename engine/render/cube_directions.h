#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>

namespace onestroke {

/// The texels of a cube map of directions: faces +x -x +y -y +z -z, rows from the top, as Vulkan lays them out.

/// How many texels a cube has with faces of `side` texels.
constexpr std::size_t cube_texels(int side) {
  return std::size_t{6} * static_cast<std::size_t>(side * side);
}

/// How many texels the levels before `level` have, the first of them with faces of `side` texels and each with half the
/// side of the one before.
constexpr std::size_t cube_texels_before(int side, int level) {
  std::size_t count = 0;
  for (int i = 0; i < level; ++i) count += cube_texels(side >> i);
  return count;
}

/// Unit direction of the middle of a texel, for faces of `side` texels.
inline glm::vec3 cube_direction(std::size_t texel, int side) {
  const auto n = static_cast<std::size_t>(side);
  const std::size_t face = texel / (n * n), row = texel / n % n, column = texel % n;
  const float u = (2 * static_cast<float>(column) + 1) / static_cast<float>(side) - 1;
  const float v = (2 * static_cast<float>(row) + 1) / static_cast<float>(side) - 1;
  switch (face) {
    case 0:
      return glm::normalize(glm::vec3(1, -v, -u));
    case 1:
      return glm::normalize(glm::vec3(-1, -v, u));
    case 2:
      return glm::normalize(glm::vec3(u, 1, v));
    case 3:
      return glm::normalize(glm::vec3(u, -1, -v));
    case 4:
      return glm::normalize(glm::vec3(u, -v, 1));
    default:
      return glm::normalize(glm::vec3(-u, -v, -1));
  }
}

/// The texel that a direction falls on.
inline std::size_t cube_texel(const glm::vec3& d, int side) {
  const glm::vec3 a = glm::abs(d);
  std::size_t face = 0;
  float u = 0, v = 0, w = 1;
  if (a.x >= a.y && a.x >= a.z) {
    face = d.x > 0 ? 0 : 1;
    w = a.x;
    u = d.x > 0 ? -d.z : d.z;
    v = -d.y;
  } else if (a.y >= a.z) {
    face = d.y > 0 ? 2 : 3;
    w = a.y;
    u = d.x;
    v = d.y > 0 ? d.z : -d.z;
  } else {
    face = d.z > 0 ? 4 : 5;
    w = a.z;
    u = d.z > 0 ? d.x : -d.x;
    v = -d.y;
  }
  const auto place = [side, w](float at) {
    const int i = static_cast<int>((at / w + 1) / 2 * static_cast<float>(side));
    return static_cast<std::size_t>(i < 0 ? 0 : i >= side ? side - 1 : i);
  };
  const auto n = static_cast<std::size_t>(side);
  return (face * n + place(v)) * n + place(u);
}

/// The solid angle of a texel, steradians; they add up to 4 pi.
inline float cube_solid_angle(std::size_t texel, int side) {
  const auto n = static_cast<std::size_t>(side);
  const float step = 2 / static_cast<float>(side);
  const float u = (static_cast<float>(texel % n) + 0.5F) * step - 1;
  const float v = (static_cast<float>(texel / n % n) + 0.5F) * step - 1;
  const float r2 = 1 + u * u + v * v;
  return step * step / (r2 * std::sqrt(r2));
}

}  // namespace onestroke
