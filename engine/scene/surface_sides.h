#pragma once

#include "scene/mesh_normals.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace onestroke {

/// Which side of a surface a point lies on, told by its nearest point: the angle-weighted pseudo-normals of Baerentzen
/// and Aanaes (2005), for which the answer is exact on closed surfaces, at edges and corners too. Vertices at one place
/// count as one.
class SurfaceSides {
 public:
  explicit SurfaceSides(const Surface& surface);

  /// The normal to compare with at the nearest point, which is given by the weights of a triangle's corners: a face's
  /// where none is zero, an edge's where one is, a corner's where two are. Not of unit length.
  glm::dvec3 normal(std::uint32_t triangle, const glm::dvec3& weights) const;

  /// Whether every edge has as many triangles that turn one way round as the other way: a volume has an inside then.
  /// Parts that touch along edges are closed if each of them is.
  bool closed() const { return closed_; }

 private:
  void join_edges(std::span<const std::uint32_t> corners);

  std::vector<glm::vec3> faces_;                  // unit
  std::vector<std::array<glm::vec3, 3>> edges_;   // opposite to each corner
  std::vector<glm::vec3> places_;                 // of each place
  std::vector<std::array<std::uint32_t, 3>> at_;  // places of each triangle's corners
  bool closed_ = true;
};

}  // namespace onestroke
