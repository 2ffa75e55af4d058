#include "scene/level_error.h"

#include "scene/triangle_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace onestroke {

namespace {

constexpr std::size_t most_samples = 10'000;
// What nobody sees: a step of colour, and the angle between two normals, 15 degrees.
constexpr double same_color = 0.04, same_normal_cos = 0.9659;
constexpr double overlooked = 0.005;  // The share of the vertices whose colours and shades are not looked at.

// What is wrong at one vertex.
struct Fault {
  double moved = 0;   // The surface or its texture.
  double unlike = 0;  // How far a colour or a shade reaches that is not its own.
};

class LevelError {
 public:
  LevelError(std::span<const ModelVertex> vertices, std::span<const std::uint32_t> coarse)
      : vertices_(vertices), coarse_(coarse), tree_(vertices, coarse), close_(1e-5 * largest(vertices)) {}

  Fault at(const ModelVertex& v) const {
    const glm::dvec3 p = glm::make_vec3(v.position.data());
    const double distance = tree_.nearest(p).distance;
    // Triangles on both sides of an edge or a seam are about as near; the vertex belongs to one of them.
    constexpr double most = std::numeric_limits<double>::infinity();
    Fault least{most, most};
    tree_.each_within(p, 1.5 * distance + close_, [&](const TriangleTree::Hit& hit) {
      const Fault fault{std::max(hit.distance, slide(v, hit)), looks_alike(v, hit) ? 0 : to_corner(v, hit)};
      if (std::max(fault.moved, fault.unlike) < std::max(least.moved, least.unlike)) least = fault;
    });
    return least;
  }

 private:
  static double largest(std::span<const ModelVertex> vertices) {
    glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper(-lower);
    for (const ModelVertex& v : vertices) {
      lower = glm::min(lower, glm::dvec3(glm::make_vec3(v.position.data())));
      upper = glm::max(upper, glm::dvec3(glm::make_vec3(v.position.data())));
    }
    return glm::distance(lower, upper);
  }

  const ModelVertex& corner(const TriangleTree::Hit& hit, std::size_t k) const {
    return vertices_[coarse_[3 * std::size_t{hit.triangle} + k]];
  }
  glm::dvec3 place(const TriangleTree::Hit& hit, std::size_t k) const {
    return glm::make_vec3(corner(hit, k).position.data());
  }

  template <std::size_t N>
  std::array<double, N> blend(const TriangleTree::Hit& hit, std::array<float, N> ModelVertex::*member) const {
    std::array<double, N> sum{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < N; ++i)
        sum[i] += hit.weights[static_cast<glm::length_t>(k)] * double{(corner(hit, k).*member)[i]};
    return sum;
  }

  // By how much the texture has moved along the triangle.
  double slide(const ModelVertex& v, const TriangleTree::Hit& hit) const {
    const auto uv = blend(hit, &ModelVertex::uv);
    const double off = std::hypot(uv[0] - double{v.uv[0]}, uv[1] - double{v.uv[1]});
    if (off < 1e-6) return 0;
    const auto at = [&](std::size_t k) { return glm::dvec2(glm::make_vec2(corner(hit, k).uv.data())); };
    const glm::dvec2 a = at(1) - at(0), b = at(2) - at(0);
    const double texels = std::abs(a.x * b.y - a.y * b.x);
    const double area = glm::length(glm::cross(place(hit, 1) - place(hit, 0), place(hit, 2) - place(hit, 0)));
    return texels > 0 ? std::min(off * std::sqrt(area / texels), to_corner(v, hit)) : to_corner(v, hit);
  }

  bool looks_alike(const ModelVertex& v, const TriangleTree::Hit& hit) const {
    const auto color = blend(hit, &ModelVertex::color);
    for (std::size_t i = 0; i < color.size(); ++i)
      if (std::abs(color[i] - double{v.color[i]}) > same_color) return false;
    const auto normal = blend(hit, &ModelVertex::normal);
    const glm::dvec3 n(normal[0], normal[1], normal[2]);
    return glm::dot(n, glm::dvec3(glm::make_vec3(v.normal.data()))) >= same_normal_cos * glm::length(n);
  }

  // What is wrong reaches no farther than to where the triangle is right again.
  double to_corner(const ModelVertex& v, const TriangleTree::Hit& hit) const {
    const glm::dvec3 p = glm::make_vec3(v.position.data());
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) nearest = std::min(nearest, glm::distance(p, place(hit, k)));
    return nearest;
  }

  const std::span<const ModelVertex> vertices_;
  const std::span<const std::uint32_t> coarse_;
  const TriangleTree tree_;
  const double close_;
};

}  // namespace

double level_error(std::span<const ModelVertex> full, std::span<const ModelVertex> vertices,
                   std::span<const std::uint32_t> coarse) {
  const LevelError measure(vertices, coarse);
  const std::size_t step = full.size() / most_samples + 1;
  double moved = 0;
  std::vector<double> unlike;
  for (std::size_t i = 0; i < full.size(); i += step) {
    const Fault fault = measure.at(full[i]);
    moved = std::max(moved, fault.moved);
    unlike.push_back(fault.unlike);
  }
  const auto rank = unlike.end() - 1 - static_cast<std::ptrdiff_t>(overlooked * static_cast<double>(unlike.size()));
  std::nth_element(unlike.begin(), rank, unlike.end());
  return std::max(moved, *rank);
}

}  // namespace onestroke
