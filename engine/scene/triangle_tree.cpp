#include "scene/triangle_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace onestroke {

namespace {

constexpr std::uint32_t leaf_size = 6;

double distance_to(const glm::dvec3& lower, const glm::dvec3& upper, const glm::dvec3& p) {
  return glm::length(glm::max(glm::max(lower - p, p - upper), glm::dvec3(0)));
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
    : vertices_(vertices), indices_(indices), order_(indices.size() / 3) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.push_back({.lower = {}, .upper = {}, .first = 0, .count = static_cast<std::uint32_t>(order_.size())});
  fit(nodes_.front());
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) divide(node);
}

glm::dvec3 TriangleTree::corner(std::uint32_t triangle, std::size_t k) const {
  const auto& p = vertices_[indices_[3 * std::size_t{triangle} + k]].position;
  return {p[0], p[1], p[2]};
}

void TriangleTree::fit(Node& node) const {
  node.lower = glm::dvec3(std::numeric_limits<double>::infinity());
  node.upper = -node.lower;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      node.lower = glm::min(node.lower, corner(order_[i], k));
      node.upper = glm::max(node.upper, corner(order_[i], k));
    }
}

// At the middle triangle along the longest side.
void TriangleTree::divide(std::uint32_t index) {
  const Node node = nodes_[index];
  if (node.count <= leaf_size) return;
  const glm::dvec3 size = node.upper - node.lower;
  const glm::length_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto place = [&](std::uint32_t t) { return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]; };
  const auto begin = order_.begin() + node.first;
  const std::uint32_t half = node.count / 2;
  std::nth_element(begin, begin + half, begin + node.count,
                   [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  Node left{.lower = {}, .upper = {}, .first = node.first, .count = half};
  Node right{.lower = {}, .upper = {}, .first = node.first + half, .count = node.count - half};
  fit(left);
  fit(right);
  nodes_[index].count = 0;
  nodes_[index].children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(left);
  nodes_.push_back(right);
}

TriangleTree::Hit TriangleTree::hit(std::uint32_t triangle, const glm::dvec3& point) const {
  const std::array t{corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  const glm::dvec3 w = nearest_weights(t, point);
  return {triangle, glm::distance(point, w.x * t[0] + w.y * t[1] + w.z * t[2]), w};
}

void TriangleTree::each_within(const glm::dvec3& point, double distance,
                               const std::function<void(const Hit&)>& take) const {
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (distance_to(node.lower, node.upper, point) > distance) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (const Hit found = hit(order_[i], point); found.distance <= distance) take(found);
    if (node.count == 0) open.insert(open.end(), {node.children, node.children + 1});
  }
}

TriangleTree::Hit TriangleTree::nearest(const glm::dvec3& point) const {
  Hit best{.distance = std::numeric_limits<double>::infinity()};
  search(0, point, best);
  return best;
}

void TriangleTree::search(std::uint32_t index, const glm::dvec3& point, Hit& best) const {
  const Node& node = nodes_[index];
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Hit found = hit(order_[i], point);
    if (found.distance < best.distance) best = found;
  }
  if (node.count > 0) return;
  const auto away = [&](std::uint32_t child) { return distance_to(nodes_[child].lower, nodes_[child].upper, point); };
  std::array order{std::pair{away(node.children), node.children},
                   std::pair{away(node.children + 1), node.children + 1}};
  if (order[1].first < order[0].first) std::swap(order[0], order[1]);
  for (const auto& [distance, child] : order)
    if (distance < best.distance) search(child, point, best);
}

}  // namespace onestroke
