#include "scene/mesh_refinement.h"

#include "solid_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

double longest_edge(const Surface& s) {
  double longest = 0;
  for (std::size_t i = 0; i < s.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      longest =
          std::max(longest, glm::distance(position(s, s.indices[i + k]), position(s, s.indices[i + (k + 1) % 3])));
  return longest;
}

/// Long and short edges side by side, so that every way of cutting a triangle comes up.
Surface crumpled_ball() {
  Surface s = ball(1, 5);
  for (ModelVertex& v : s.vertices) {
    const glm::dvec3 p(v.position[0], v.position[1], v.position[2]);
    const double scale = 1 + 0.4 * std::sin(5 * p.x + 3 * p.y) * std::cos(7 * p.z);
    v.position = {static_cast<float>(9 * scale * p.x), static_cast<float>(scale * p.y),
                  static_cast<float>(scale * p.z)};
  }
  return s;
}

TEST(MeshRefinement, KeepsTheSurfaceAndMakesEdgesShort) {
  const Surface whole = box({0.5, 0.25, 0.125}, 1);
  const Surface fine = refine(whole, {.longest_edge = 0.02});
  EXPECT_LE(longest_edge(fine), 0.02);
  EXPECT_GT(longest_edge(fine), 0.01) << "no shorter than they have to be";
  const SurfaceMeasures before = measure(whole), after = measure(fine);
  EXPECT_TRUE(after.closed);
  EXPECT_NEAR(after.area / before.area, 1, 1e-9);
  EXPECT_NEAR(after.volume / before.volume, 1, 1e-9);
  for (std::size_t i = 0; i < whole.vertices.size(); ++i) EXPECT_EQ(position(fine, i), position(whole, i));
}

TEST(MeshRefinement, OpensNoCracksHoweverEdgesAreCut) {
  const Surface whole = crumpled_ball();
  ASSERT_TRUE(measure(whole).closed);
  for (const double edge : {1.0, 0.3, 0.1}) {
    const Surface fine = refine(whole, {.longest_edge = edge});
    EXPECT_LE(longest_edge(fine), edge);
    const SurfaceMeasures before = measure(whole), after = measure(fine);
    EXPECT_TRUE(after.closed) << edge;
    // The floats of halved edges are rounded, one this way and one that.
    EXPECT_NEAR(after.area / before.area, 1, 1e-7);
    EXPECT_NEAR(after.volume / before.volume, 1, 1e-7);
  }
}

TEST(MeshRefinement, LeavesWhatIsFineAsItIs) {
  const Surface fine = ball(1, 20);
  const Surface same = refine(fine, {.longest_edge = 0.2});
  EXPECT_EQ(same.indices, fine.indices);
  EXPECT_EQ(same.vertices.size(), fine.vertices.size());
  // Too many triangles already.
  EXPECT_EQ(refine(fine, {.longest_edge = 0.01, .most_triangles = 1000}).indices, fine.indices);
}

TEST(MeshRefinement, LetsEdgesBeLongerWhereThereWouldBeTooManyTriangles) {
  const Surface fine = refine(box({0.5, 0.25, 0.125}, 1), {.longest_edge = 1e-4, .most_triangles = 10'000});
  EXPECT_LE(fine.indices.size() / 3, 10'000U);
  EXPECT_GT(fine.indices.size() / 3, 2'000U);
  EXPECT_TRUE(measure(fine).closed);
}

TEST(MeshRefinement, InterpolatesNormals) {
  Surface s;
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) add_vertex(s, p);
  s.vertices[0].normal = {0, 0, 1};
  s.vertices[1].normal = {1, 0, 0};
  s.vertices[2].normal = {0, 0, -1};
  s.indices = {0, 1, 2};
  const Surface fine = refine(s, {.longest_edge = 0.8});
  ASSERT_EQ(fine.indices.size(), 12U);
  for (const ModelVertex& v : fine.vertices) {
    const auto& n = v.normal;
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-6);
    if (v.position == std::array<float, 3>{0.5F, 0, 0}) {
      EXPECT_NEAR(n[0], std::sqrt(0.5), 1e-6);
    }
  }
}

}  // namespace
}  // namespace onestroke
