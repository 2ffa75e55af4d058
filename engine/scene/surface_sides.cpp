#include "scene/surface_sides.h"

#include "scene/mesh_weld.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

struct Corners {
  std::array<glm::dvec3, 3> at;

  Corners(const Surface& surface, std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = glm::make_vec3(surface.vertices[surface.indices[3 * triangle + k]].position.data());
  }
  /// Zero where the triangle has no area.
  glm::dvec3 face() const {
    const glm::dvec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
    const double length = glm::length(across);
    return length > 0 ? across / length : glm::dvec3(0);
  }
  double angle(std::size_t k) const {
    const glm::dvec3 a = at[(k + 1) % 3] - at[k], b = at[(k + 2) % 3] - at[k];
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  }
};

/// One side of a triangle, as an edge between two places.
struct Side {
  std::uint64_t edge = 0;  // the lesser place first
  std::uint32_t side = 0;  // 3 * triangle + the corner that is opposite
  bool forward = false;    // from the lesser place to the greater
};

}  // namespace

SurfaceSides::SurfaceSides(const Surface& surface) {
  const Places places = find_places(surface);
  const std::size_t count = surface.indices.size() / 3;
  faces_.resize(count);
  edges_.resize(count);
  at_.resize(count);
  std::vector<glm::dvec3> sums(places.count, glm::dvec3(0));
  for (std::size_t i = 0; i < count; ++i) {
    const Corners corners(surface, i);
    const glm::dvec3 face = corners.face();
    faces_[i] = face;
    for (std::size_t k = 0; k < 3; ++k) {
      at_[i][k] = places.of_vertex[surface.indices[3 * i + k]];
      sums[at_[i][k]] += corners.angle(k) * face;
    }
  }
  places_.assign(sums.begin(), sums.end());
  join_edges(std::span(at_.front().data(), 3 * count));
}

void SurfaceSides::join_edges(std::span<const std::uint32_t> corners) {
  // A triangle with two corners at one place is no more than an edge itself.
  const auto flat = [corners](std::uint32_t side) {
    const std::uint32_t* c = &corners[side / 3 * 3];
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
  };
  const auto evenly_joined = [&flat](auto first, auto end) {
    int forward = 0, backward = 0;
    for (auto s = first; s != end; ++s)
      if (!flat(s->side)) ++(s->forward ? forward : backward);
    return forward == backward;
  };
  std::vector<Side> sides(corners.size());
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    const std::uint32_t triangle = i / 3 * 3, from = corners[triangle + (i + 1) % 3],
                        to = corners[triangle + (i + 2) % 3];
    sides[i] = {std::uint64_t{std::min(from, to)} << 32U | std::max(from, to), i, from < to};
  }
  std::ranges::sort(sides, {}, &Side::edge);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto end = std::find_if(first, sides.end(), [first](const Side& s) { return s.edge != first->edge; });
    glm::vec3 sum(0.0F);
    for (auto s = first; s != end; ++s) sum += faces_[s->side / 3];
    for (auto s = first; s != end; ++s) edges_[s->side / 3][s->side % 3] = sum;
    closed_ = closed_ && evenly_joined(first, end);
    first = end;
  }
}

glm::dvec3 SurfaceSides::normal(std::uint32_t triangle, const glm::dvec3& weights) const {
  std::array<std::size_t, 3> used{};
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[static_cast<glm::length_t>(k)] > 0) used[count++] = k;
  if (count == 3) return faces_[triangle];
  if (count == 2) return edges_[triangle][3 - used[0] - used[1]];
  return places_[at_[triangle][used[0]]];
}

}  // namespace onestroke
