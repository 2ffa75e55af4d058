#include "difference_scenes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace onestroke::bench {
namespace {

void add_vertex(Surface& s, const glm::dvec3& p) {
  s.vertices.push_back({.position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                        .normal = {},
                        .tangent = {},
                        .uv = {},
                        .color = {}});
}

/// Squares between vertices that were added row by row; they face to where rows and columns turn, right-handed.
void add_squares(Surface& s, std::uint32_t base, std::uint32_t rows, std::uint32_t columns) {
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t a = base + i * (columns + 1) + j, b = a + columns + 1;
      s.indices.insert(s.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
}

/// By meridians, the first at `turn`; radius(meridian, parallel). Radians.
template <typename Radius>
Surface ball(int triangles, double turn, Radius radius) {
  const auto across = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0))), around = 2 * across;
  Surface s;
  for (std::uint32_t i = 0; i <= around; ++i)
    for (std::uint32_t j = 0; j <= across; ++j) {
      const double a = turn + 2 * std::numbers::pi * (i % around) / around, b = std::numbers::pi * j / across;
      add_vertex(s, radius(a, b) * glm::dvec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)));
    }
  add_squares(s, 0, around, across);
  return s;
}

Surface box(int triangles, const glm::vec3& half) {
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 12.0)));
  Surface s;
  for (glm::length_t axis = 0; axis < 3; ++axis)
    for (const int way : {1, -1}) {
      const auto base = static_cast<std::uint32_t>(s.vertices.size());
      for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
          glm::dvec3 p(half);
          p[axis] *= way;
          p[(axis + 1) % 3] *= 2.0 * i / n - 1;
          p[(axis + 2) % 3] *= way * (2.0 * j / n - 1);
          add_vertex(s, p);
        }
      add_squares(s, base, n, n);
    }
  return s;
}

double distance_to_box(const glm::dvec3& p, const glm::dvec3& half) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, glm::dvec3(0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

double distance_to_side(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 side = b - a;
  const double length2 = glm::dot(side, side);
  const double share = length2 > 0 ? std::clamp(glm::dot(p - a, side) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + share * side);
}

double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 across = glm::cross(b - a, c - a);
  const auto within = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), across) >= 0;
  };
  const double area = glm::length(across);
  if (area > 0 && within(a, b) && within(b, c) && within(c, a)) return std::abs(glm::dot(p - a, across)) / area;
  return std::min({distance_to_side(p, a, b), distance_to_side(p, b, c), distance_to_side(p, c, a)});
}

std::string named(const std::string& what, int triangles) {
  return what + ", " + std::to_string(triangles / 1000) + "k triangles each";
}

}  // namespace

DifferenceScene two_balls(int triangles) {
  constexpr double inner = 0.050, outer = 0.051;
  return {.name = named("two balls", triangles),
          .own = ball(triangles, 0.3, [](double, double) { return outer; }),
          .other = ball(triangles, 0, [](double, double) { return inner; }),
          .distance = [](const glm::dvec3& p) { return glm::length(p) - inner; },
          .size = 2 * outer * std::sqrt(3)};
}

DifferenceScene wavy_ball_and_box(int triangles) {
  const glm::vec3 half(0.030F, 0.035F, 0.045F);
  return {
      .name = named("wavy ball and box", triangles),
      .own = ball(triangles, 0.3, [](double a, double b) { return 0.048 + 0.003 * std::sin(9 * a) * std::sin(9 * b); }),
      .other = box(triangles, half),
      .distance = [half](const glm::dvec3& p) { return distance_to_box(p, half); },
      .size = 2.0 * glm::length(half)};
}

glm::dvec3 position_of(const Surface& surface, std::size_t vertex) {
  const auto& p = surface.vertices[vertex].position;
  return {p[0], p[1], p[2]};
}

double brute_distance(const Surface& surface, const glm::dvec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return position_of(surface, surface.indices[i + k]); };
    least = std::min(least, distance_to_triangle(point, at(0), at(1), at(2)));
  }
  return least;
}

double largest_error(const DifferenceScene& scene, const SurfaceDifference& difference) {
  double largest = 0;
  for (std::size_t i = 0; i < scene.own.vertices.size(); ++i)
    largest = std::max(largest, std::abs(difference.distances[i] - scene.distance(position_of(scene.own, i))));
  return largest;
}

}  // namespace onestroke::bench
