#pragma once

#include "scene/mesh_normals.h"
#include "scene/surface_difference.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

// Surfaces of solids whose measures and distances are known.
namespace onestroke {

inline glm::dvec3 position(const Surface& s, std::size_t i) {
  const auto& p = s.vertices[i].position;
  return {p[0], p[1], p[2]};
}

inline void add_vertex(Surface& s, const glm::dvec3& p) {
  s.vertices.push_back({.position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                        .normal = {},
                        .tangent = {},
                        .uv = {},
                        .color = {}});
}

/// A grid of n by n squares on a face of a box; it faces where u and v turn about, right-handed.
inline void add_face(Surface& s, const glm::dvec3& middle, const glm::dvec3& u, const glm::dvec3& v, int n) {
  const auto base = static_cast<std::uint32_t>(s.vertices.size());
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) add_vertex(s, middle + (2.0 * i / n - 1) * u + (2.0 * j / n - 1) * v);
  for (std::uint32_t i = 0; i + 1 < row; ++i)
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = base + i * row + j;
      s.indices.insert(s.indices.end(), {a, a + row, a + 1, a + 1, a + row, a + row + 1});
    }
}

/// Every face has vertices of its own, as files with hard edges have.
inline Surface box(const glm::dvec3& half, int n) {
  Surface s;
  const glm::dvec3 x(half.x, 0, 0), y(0, half.y, 0), z(0, 0, half.z);
  add_face(s, x, y, z, n);
  add_face(s, -x, z, y, n);
  add_face(s, y, z, x, n);
  add_face(s, -y, x, z, n);
  add_face(s, z, x, y, n);
  add_face(s, -z, y, x, n);
  return s;
}

inline double distance_to_box(const glm::dvec3& p, const glm::dvec3& half) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, glm::dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

/// A box blown up to a ball, n by n squares a side; its corners lie on the ball but for the rounding of floats.
inline Surface ball(double radius, int n) {
  Surface s = box({1, 1, 1}, n);
  for (ModelVertex& v : s.vertices) {
    const glm::dvec3 p = glm::normalize(glm::dvec3(v.position[0], v.position[1], v.position[2])) * radius;
    v.position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  return s;
}

using Cell = glm::ivec3;

/// A solid of cubes of a side, those of the cells from 0 to count that `is_full` says; closed.
inline Surface cubes(double side, const Cell& count, const std::function<bool(const Cell&)>& is_full) {
  const auto full = [&](const Cell& c) {
    for (glm::length_t k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= count[k]) return false;
    return is_full(c);
  };
  Surface s;
  Cell c;
  for (c.x = 0; c.x < count.x; ++c.x)
    for (c.y = 0; c.y < count.y; ++c.y)
      for (c.z = 0; c.z < count.z; ++c.z)
        for (glm::length_t axis = 0; axis < 3 && full(c); ++axis)
          for (const int way : {-1, 1}) {
            Cell next = c;
            next[axis] += way;
            if (full(next)) continue;
            glm::dvec3 out(0), u(0), v(0);
            out[axis] = way * side / 2;
            u[(axis + 1) % 3] = side / 2;
            v[(axis + 2) % 3] = way * side / 2;
            add_face(s, (glm::dvec3(c) + 0.5) * side + out, u, v, 1);
          }
  return s;
}

/// As files have it, with normals that keep edges hard.
inline Model model_of(Surface surface, std::string name = "solid") {
  compute_normals(surface, usual_crease);
  Model model;
  model.name = std::move(name);
  model.vertices = std::move(surface.vertices);
  model.indices = std::move(surface.indices);
  model.parts.push_back({.first_index = 0, .index_count = static_cast<std::uint32_t>(model.indices.size())});
  model.materials.emplace_back();
  return model;
}

}  // namespace onestroke
