#pragma once

#include "scene/model.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace onestroke {

/// Finds the point of a surface that is nearest to a given one: a tree of boxes round its triangles.
class TriangleTree {
 public:
  struct Hit {
    std::uint32_t triangle = 0;
    double distance = 0;
    glm::dvec3 weights{};  ///< Of the triangle's corners at the nearest point; their sum is 1.
  };

  /// Both outlive the tree; three indices a triangle, at least one triangle.
  TriangleTree(std::span<const ModelVertex> vertices, std::span<const std::uint32_t> indices);

  Hit nearest(const glm::dvec3& point) const;
  /// Every triangle that comes so near, each with its own nearest point.
  void each_within(const glm::dvec3& point, double distance, const std::function<void(const Hit&)>& take) const;

 private:
  struct Node {
    glm::dvec3 lower, upper;
    std::uint32_t first = 0, count = 0;  // Of order_; a node with children has count 0,
    std::uint32_t children = 0;          // and two of them one behind the other here.
  };

  glm::dvec3 corner(std::uint32_t triangle, std::size_t k) const;
  void fit(Node& node) const;
  void divide(std::uint32_t node);
  Hit hit(std::uint32_t triangle, const glm::dvec3& point) const;
  void search(std::uint32_t node, const glm::dvec3& point, Hit& best) const;

  std::span<const ModelVertex> vertices_;
  std::span<const std::uint32_t> indices_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace onestroke
