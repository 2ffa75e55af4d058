#include "app/rod_mesh.h"

#include "scene/frames.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace onestroke {

/// For the test's name, which must not change from run to run.
static void PrintTo(const Shape& shape, std::ostream* out) {
  constexpr const char* kinds[] = {"angle", "stroke", "line"};
  *out << kinds[static_cast<int>(shape.kind())] << " bent by " << shape.bend_radius();
}

namespace {

glm::vec3 at(const Model& model, std::uint32_t index) {
  const auto& p = model.vertices[index].position;
  return {p[0], p[1], p[2]};
}

/// mm^3; positive where every triangle faces outwards.
double volume(const Model& model) {
  double six = 0;
  for (std::size_t i = 0; i < model.indices.size(); i += 3)
    six += glm::dot(at(model, model.indices[i]),
                    glm::cross(at(model, model.indices[i + 1]), at(model, model.indices[i + 2])));
  return six / 6 * 1e9;
}

/// Every edge lies between two triangles that go round it opposite ways; places count, not indices.
bool closed(const Model& model) {
  using Place = std::array<long, 3>;
  const auto place = [&](std::uint32_t index) {
    const glm::vec3 p = at(model, index) * 1e6F;
    return Place{std::lround(p.x), std::lround(p.y), std::lround(p.z)};
  };
  std::map<std::pair<Place, Place>, int> edges;
  for (std::size_t i = 0; i < model.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{place(model.indices[i + k]), place(model.indices[i + (k + 1) % 3])}];
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return true;
}

class RodMesh : public testing::TestWithParam<Shape> {};

TEST_P(RodMesh, IsTheRod) {
  const Shape& shape = GetParam();
  const Model model = rod_mesh(shape);
  EXPECT_TRUE(closed(model));
  const double round = std::numbers::pi * shape.radius() * shape.radius() * shape.length();
  EXPECT_GT(volume(model), 0.97 * round);
  EXPECT_LT(volume(model), 1.001 * round);
  for (const ModelVertex& v : model.vertices) {
    const Vec3 p = point_from_graphics({v.position[0], v.position[1], v.position[2]});
    double nearest = INFINITY;
    for (double s = 0; s <= shape.length(); s += 0.05) nearest = std::min(nearest, norm(p - shape.at(s).position));
    // The outer corner of a mitre stands farther out.
    EXPECT_LT(nearest, shape.bend_radius() > 0 ? 3.01 : 3.01 * std::numbers::sqrt2);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GE(v.position[i], model.lower[i]);
      EXPECT_LE(v.position[i], model.upper[i]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, RodMesh,
    testing::Values(Shape::angle(36, 4, 3, 0), Shape::angle(36, 4, 3, 8), Shape::line(20, 4, 3),
                    Shape::stroke(20, 4, 3, 6, {{0, 0, 0}, {0, 30, 0}, {30, 30, 0}, {30, 30, 25.15}}),
                    Shape::stroke(18, 5, 3, 0, {{0, 0, 0}, {0, 30, 0}, {30, 30, 0}, {30, 30, 30}})));

}  // namespace
}  // namespace onestroke
