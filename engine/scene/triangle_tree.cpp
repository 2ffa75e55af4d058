#include "scene/triangle_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace onestroke {

namespace {

constexpr std::uint32_t leaf_size = 6;

double distance_to(const glm::vec3& lower, const glm::vec3& upper, const glm::dvec3& p) {
  return glm::length(glm::max(glm::max(glm::dvec3(lower) - p, p - glm::dvec3(upper)), glm::dvec3(0)));
}

// For triangles that have no area.
glm::dvec3 nearest_weights_on_sides(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
  glm::dvec3 best(1, 0, 0);
  double least = std::numeric_limits<double>::infinity();
  for (glm::length_t k = 0; k < 3; ++k) {
    const glm::length_t next = (k + 1) % 3;
    const glm::dvec3 from = t[static_cast<std::size_t>(k)], side = t[static_cast<std::size_t>(next)] - from;
    const double length2 = glm::dot(side, side);
    const double share = length2 > 0 ? std::clamp(glm::dot(p - from, side) / length2, 0.0, 1.0) : 0;
    const double distance = glm::distance(p, from + share * side);
    if (distance >= least) continue;
    least = distance;
    best = glm::dvec3(0);
    best[k] = 1 - share;
    best[next] = share;
  }
  return best;
}

// The corners' weights at the triangle's nearest point: by the regions about it (Ericson, Real-Time Collision
// Detection, 5.1.5).
glm::dvec3 nearest_weights(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
  const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
               d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double c = d1 * d4 - d3 * d2, b = d5 * d2 - d1 * d6, a = d3 * d6 - d5 * d4;
  if (c <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (b <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double along = d4 - d3, back = d5 - d6;
  if (a <= 0 && along >= 0 && back >= 0) return {0, back / (along + back), along / (along + back)};
  return glm::dvec3(a, b, c) / (a + b + c);
}

}  // namespace

TriangleTree::TriangleTree(std::span<const ModelVertex> vertices, std::span<const std::uint32_t> indices)
    : triangles_(indices.size() / 3), place_of_(triangles_.size()) {
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    triangles_[i].number = i;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& p = vertices[indices[3 * std::size_t{i} + k]].position;
      triangles_[i].corners[k] = {p[0], p[1], p[2]};
    }
  }
  nodes_.push_back({.lower = {}, .upper = {}, .first = 0, .count = static_cast<std::uint32_t>(triangles_.size())});
  fit(nodes_.front());
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) divide(node);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) place_of_[triangles_[i].number] = i;
}

void TriangleTree::fit(Node& node) const {
  node.lower = glm::vec3(std::numeric_limits<float>::infinity());
  node.upper = -node.lower;
  for (const Triangle& triangle : std::span(triangles_).subspan(node.first, node.count))
    for (const glm::vec3& corner : triangle.corners) {
      node.lower = glm::min(node.lower, corner);
      node.upper = glm::max(node.upper, corner);
    }
}

// At the middle triangle along the longest side.
void TriangleTree::divide(std::uint32_t index) {
  const Node node = nodes_[index];
  if (node.count <= leaf_size) return;
  const glm::vec3 size = node.upper - node.lower;
  const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = triangles_.begin() + node.first;
  const std::uint32_t half = node.count / 2;
  std::nth_element(begin, begin + half, begin + node.count,
                   [axis](const Triangle& a, const Triangle& b) { return a.place(axis) < b.place(axis); });
  Node left{.lower = {}, .upper = {}, .first = node.first, .count = half};
  Node right{.lower = {}, .upper = {}, .first = node.first + half, .count = node.count - half};
  fit(left);
  fit(right);
  nodes_[index].count = 0;
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(left);
  nodes_.push_back(right);
}

TriangleTree::Hit TriangleTree::hit(const Triangle& triangle, const glm::dvec3& point) {
  const std::array t{glm::dvec3(triangle.corners[0]), glm::dvec3(triangle.corners[1]), glm::dvec3(triangle.corners[2])};
  glm::dvec3 w = nearest_weights(t, point);
  if (!(w.x + w.y + w.z > 0)) w = nearest_weights_on_sides(t, point);
  const glm::dvec3 at = w.x * t[0] + w.y * t[1] + w.z * t[2];
  return {triangle.number, glm::distance(point, at), at, w};
}

void TriangleTree::each_within(const glm::dvec3& point, double distance,
                               const std::function<void(const Hit&)>& take) const {
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (distance_to(node.lower, node.upper, point) > distance) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (const Hit found = hit(triangles_[i], point); found.distance <= distance) take(found);
    if (node.count == 0) open.insert(open.end(), {node.first, node.first + 1});
  }
}

TriangleTree::Hit TriangleTree::nearest(const glm::dvec3& point, std::uint32_t guess) const {
  Hit best = hit(triangles_[place_of_[guess]], point);
  search(0, point, best);
  return best;
}

void TriangleTree::search(std::uint32_t index, const glm::dvec3& point, Hit& best) const {
  const Node& node = nodes_[index];
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Hit found = hit(triangles_[i], point);
    if (found.distance < best.distance) best = found;
  }
  if (node.count > 0) return;
  const auto away = [&](std::uint32_t child) { return distance_to(nodes_[child].lower, nodes_[child].upper, point); };
  std::array order{std::pair{away(node.first), node.first}, std::pair{away(node.first + 1), node.first + 1}};
  if (order[1].first < order[0].first) std::swap(order[0], order[1]);
  for (const auto& [distance, child] : order)
    if (distance < best.distance) search(child, point, best);
}

}  // namespace onestroke
