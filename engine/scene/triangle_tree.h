#pragma once

#include "scene/model.h"

#include <glm/vec3.hpp>

#include <array>
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
    glm::dvec3 point{};
    glm::dvec3 weights{};  ///< Of the triangle's corners at that point; their sum is 1, and one that has no part is 0.
  };

  /// Three indices a triangle, at least one triangle.
  TriangleTree(std::span<const ModelVertex> vertices, std::span<const std::uint32_t> indices);

  /// Any triangle will do as a guess; a near one saves most of the search.
  Hit nearest(const glm::dvec3& point, std::uint32_t guess = 0) const;
  /// Every triangle that comes so near, each with its own nearest point.
  void each_within(const glm::dvec3& point, double distance, const std::function<void(const Hit&)>& take) const;

 private:
  struct Triangle {
    std::array<glm::vec3, 3> corners;
    std::uint32_t number = 0;
    float place(glm::length_t axis) const { return corners[0][axis] + corners[1][axis] + corners[2][axis]; }
  };
  struct Node {
    glm::vec3 lower, upper;
    std::uint32_t first = 0;  // Of triangles_, or, where there are none, of two nodes one behind the other.
    std::uint32_t count = 0;  // Triangles.
  };

  void fit(Node& node) const;
  void divide(std::uint32_t node);
  static Hit hit(const Triangle& triangle, const glm::dvec3& point);
  void search(std::uint32_t node, const glm::dvec3& point, Hit& best) const;

  std::vector<Triangle> triangles_;      // in the order of the leaves
  std::vector<std::uint32_t> place_of_;  // of each triangle in that order
  std::vector<Node> nodes_;
};

}  // namespace onestroke
