#include "scene/mesh_levels.h"

#include "scene/level_error.h"
#include "scene/mesh_weld.h"
#include "scene/triangle_tree.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <set>

namespace onestroke {
namespace {

ModelVertex vertex(const glm::dvec3& p, const glm::dvec3& n) {
  ModelVertex v{{}, {}, {1, 0, 0, 1}, {}, {1, 1, 1, 1}};
  for (glm::length_t k = 0; k < 3; ++k) {
    v.position[static_cast<std::size_t>(k)] = static_cast<float>(p[k]);
    v.normal[static_cast<std::size_t>(k)] = static_cast<float>(n[k]);
  }
  return v;
}

// A grid of n x n squares, each point placed by its (u, v) from 0 to 1.
Surface sheet(std::uint32_t n, const std::function<ModelVertex(double, double)>& place) {
  Surface s;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) s.vertices.push_back(place(double{1} * i / n, double{1} * j / n));
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      s.indices.insert(s.indices.end(), {a, b, d, a, d, c});
    }
  return s;
}

ModelVertex on_ball(double u, double v) {
  const double theta = std::numbers::pi * (0.01 + 0.98 * v), phi = 2 * std::numbers::pi * u;
  const glm::dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
  return vertex(0.05 * n, n);
}

ModelVertex on_plane(double u, double v) {
  return vertex({0.1 * u, 0.1 * v, 0}, {0, 0, 1});
}

Model model_of(const std::vector<Surface>& surfaces) {
  Model m;
  m.name = "made";
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    m.materials.emplace_back();
    const auto base = static_cast<std::uint32_t>(m.vertices.size());
    m.parts.push_back({static_cast<std::uint32_t>(m.indices.size()),
                       static_cast<std::uint32_t>(surfaces[i].indices.size()), static_cast<int>(i)});
    m.vertices.insert(m.vertices.end(), surfaces[i].vertices.begin(), surfaces[i].vertices.end());
    for (const std::uint32_t k : surfaces[i].indices) m.indices.push_back(base + k);
  }
  return m;
}

std::span<const std::uint32_t> indices_of(const Model& m, const ModelPart& part) {
  return std::span(m.indices).subspan(part.first_index, part.index_count);
}

TEST(TriangleTree, FindsWhatALookAtEveryTriangleFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.08, 0.08);
  const Surface ball = sheet(24, on_ball);
  const TriangleTree tree(ball.vertices, ball.indices);
  for (int round = 0; round < 200; ++round) {
    const glm::dvec3 p(anywhere(random), anywhere(random), anywhere(random));
    double least = std::numeric_limits<double>::infinity();
    std::set<std::uint32_t> near;
    for (std::uint32_t t = 0; t < ball.indices.size() / 3; ++t) {
      const TriangleTree one(ball.vertices, std::span(ball.indices).subspan(std::size_t{3} * t, 3));
      const double distance = one.nearest(p).distance;
      least = std::min(least, distance);
      if (distance < 0.03) near.insert(t);
    }
    const TriangleTree::Hit hit = tree.nearest(p);
    EXPECT_NEAR(hit.distance, least, 1e-12);
    EXPECT_NEAR(hit.weights.x + hit.weights.y + hit.weights.z, 1, 1e-9);
    std::set<std::uint32_t> found;
    tree.each_within(p, 0.03, [&](const TriangleTree::Hit& h) { found.insert(h.triangle); });
    EXPECT_EQ(found, near);
  }
}

TEST(TriangleTree, KnowsEveryRegionAboutATriangle) {
  const std::vector<ModelVertex> t{vertex({0, 0, 0}, {}), vertex({2, 0, 0}, {}), vertex({0, 2, 0}, {})};
  const std::vector<std::uint32_t> order{0, 1, 2};
  const TriangleTree tree(t, order);
  EXPECT_DOUBLE_EQ(tree.nearest({0.5, 0.5, 3}).distance, 3);
  EXPECT_DOUBLE_EQ(tree.nearest({-3, -4, 0}).distance, 5);
  EXPECT_DOUBLE_EQ(tree.nearest({5, -4, 0}).distance, 5);
  EXPECT_DOUBLE_EQ(tree.nearest({1, -2, 0}).distance, 2);
  EXPECT_DOUBLE_EQ(tree.nearest({-2, 1, 0}).distance, 2);
  EXPECT_NEAR(tree.nearest({2, 2, 0}).distance, std::sqrt(2), 1e-12);
}

TEST(Weld, MakesOneOfEqualVerticesAndLeavesOutTheUnused) {
  Surface s;
  s.vertices = {vertex({0, 0, 0}, {}),    vertex({9, 9, 9}, {}), vertex({1, 0, 0}, {}),
                vertex({-0.0, 0, 0}, {}), vertex({1, 1, 0}, {}), vertex({1, 0, 0}, {1, 0, 0})};
  s.indices = {0, 2, 4, 3, 4, 5};
  weld(s);
  EXPECT_EQ(s.vertices.size(), 4U) << "0 and -0 are the same place; another normal is another vertex";
  EXPECT_EQ(s.indices[0], s.indices[3]);
  EXPECT_NE(s.indices[1], s.indices[5]);
  Surface none{{vertex({0, 0, 0}, {})}, {}};
  weld(none);
  EXPECT_TRUE(none.vertices.empty());
}

TEST(Levels, HalveTheTrianglesAgainAndAgainWithGrowingErrors) {
  Model m = model_of({sheet(128, on_ball)});
  const std::size_t full = m.indices.size();
  add_levels(m);
  ASSERT_GE(m.levels.size(), 3U);
  EXPECT_EQ(m.parts[0].index_count, full - 0U);
  float error = 0;
  std::uint32_t count = m.parts[0].index_count;
  for (const ModelLevel& level : m.levels) {
    ASSERT_EQ(level.parts.size(), 1U);
    EXPECT_LE(level.parts[0].index_count, 0.75 * count);
    EXPECT_GE(level.error, error);
    EXPECT_GT(level.error, 0);
    count = level.parts[0].index_count;
    error = level.error;
  }
  EXPECT_LT(m.levels.front().error, 0.001F);
  EXPECT_LT(error, 0.05F);
}

TEST(Levels, AreNoFartherOffThanTheySay) {
  Model m = model_of({sheet(96, on_ball)});
  add_levels(m);
  ASSERT_FALSE(m.levels.empty());
  for (const ModelLevel& level : m.levels) {
    const TriangleTree tree(m.vertices, indices_of(m, level.parts[0]));
    double farthest = 0;
    for (const ModelVertex& v : m.vertices)
      farthest = std::max(farthest, tree.nearest(glm::dvec3(glm::make_vec3(v.position.data()))).distance);
    EXPECT_LE(farthest, double{level.error} * 1.0001);
    EXPECT_GT(farthest, 0);
  }
}

// Otherwise they would be lit from behind, in spots.
void expect_one_side(double side) {
  Model m = model_of({sheet(200, [&](double u, double v) {
    ModelVertex made = on_ball(u, v);
    const double bump = 1 + 0.05 * std::sin(40 * u) * std::sin(30 * v);
    for (float& x : made.position) x = static_cast<float>(double{x} * bump);
    for (float& x : made.normal) x *= static_cast<float>(side);
    return made;
  })});
  add_levels(m);
  ASSERT_GE(m.levels.size(), 4U);
  for (const ModelLevel& level : m.levels) {
    const auto indices = indices_of(m, level.parts[0]);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const auto point = [&](std::size_t k) {
        return glm::dvec3(glm::make_vec3(m.vertices[indices[i + k]].position.data()));
      };
      const auto normal = [&](std::size_t k) {
        return glm::dvec3(glm::make_vec3(m.vertices[indices[i + k]].normal.data()));
      };
      const glm::dvec3 face = glm::cross(point(1) - point(0), point(2) - point(0));
      EXPECT_GE(side * glm::dot(face, normal(0) + normal(1) + normal(2)), 0);
    }
  }
}

TEST(Levels, FaceToWhereTheirNormalsDo) {
  expect_one_side(1);
}

TEST(Levels, OfASurfaceThatIsInsideOutAreSoToo) {
  expect_one_side(-1);
}

TEST(Levels, CostNothingWhereTheSurfaceIsFlat) {
  Model m = model_of({sheet(80, on_plane)});
  add_levels(m);
  ASSERT_FALSE(m.levels.empty());
  EXPECT_LT(m.levels.back().error, 1e-6F);
  EXPECT_LT(m.levels.back().parts[0].index_count, m.parts[0].index_count / 4);
}

// Stripes of 4 mm on a flat sheet of 100 mm.
ModelVertex striped(double u, double v) {
  ModelVertex made = on_plane(u, v);
  if (std::fmod(u, 0.08) < 0.04) made.color = {1, 0, 0, 1};
  return made;
}

TEST(Levels, KeepColoursThatNoEdgeHolds) {
  Model m = model_of({sheet(100, striped)});
  add_levels(m);
  ASSERT_FALSE(m.levels.empty());
  EXPECT_LT(m.levels.front().error, 0.0005F);
  EXPECT_LT(m.levels.front().parts[0].index_count, 0.6 * m.parts[0].index_count);
}

TEST(Levels, CountAColourThatIsLostAsAnError) {
  const Surface s = sheet(100, striped);
  const std::vector<std::uint32_t> corners{0, 100, 101 * 100 + 100, 0, 101 * 100 + 100, 101 * 100};
  EXPECT_GT(level_error(s.vertices, s.vertices, corners), 0.03) << "it is wrong all over";
  Surface rough = sheet(100, on_plane);
  for (std::size_t i = 0; i < rough.vertices.size(); i += 3) rough.vertices[i].normal = {0.6F, 0, 0.8F};
  EXPECT_GT(level_error(rough.vertices, rough.vertices, corners), 0.03) << "and so is a shade";
}

TEST(Levels, CountATextureThatSlidesAsAnError) {
  const Surface s = sheet(40, [](double u, double v) {
    ModelVertex made = on_plane(u, v);
    made.uv = {static_cast<float>(u * u), static_cast<float>(v)};
    return made;
  });
  const std::vector<std::uint32_t> corners{0, 40, 41 * 40 + 40, 0, 41 * 40 + 40, 41 * 40};
  // In the middle u * u is 0.25 where the two triangles have 0.5: a quarter of the 100 mm.
  EXPECT_NEAR(level_error(s.vertices, s.vertices, corners), 0.025, 0.001);
  const Surface even = sheet(40, [](double u, double v) {
    ModelVertex made = on_plane(u, v);
    made.uv = {static_cast<float>(u), static_cast<float>(v)};
    return made;
  });
  EXPECT_LT(level_error(even.vertices, even.vertices, corners), 1e-6);
}

// Two walls that meet in a straight hard edge of many points: the edge may be thinned out at no cost, although its
// points lie on both walls and match one of them.
TEST(Levels, KeepHardEdgesWithoutCountingThemAsErrors) {
  Surface s = sheet(40, on_plane);
  append(sheet(40, [](double u, double v) { return vertex({0.1 * u, 0, -0.1 * v}, {0, -1, 0}); }), s);
  Model m = model_of({s});
  add_levels(m);
  ASSERT_FALSE(m.levels.empty());
  EXPECT_LT(m.levels.front().error, 1e-5F);
}

TEST(Levels, KeepPartsInTheirOrderAndShareVertices) {
  Model m = model_of({sheet(64, on_ball), sheet(2, on_plane), sheet(90, on_plane)});
  m.vertices.push_back(vertex({5, 5, 5}, {0, 0, 1}));
  const std::size_t before = m.vertices.size();
  double last = 0;
  add_levels(m, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1);
  EXPECT_LT(m.vertices.size(), before) << "without the one that no index names, and the ball's seam welded";
  ASSERT_EQ(m.parts.size(), 3U);
  EXPECT_EQ(m.parts[1].index_count, 24U);
  for (const std::uint32_t i : m.indices) ASSERT_LT(i, m.vertices.size());
  for (const ModelLevel& level : m.levels) {
    ASSERT_EQ(level.parts.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(level.parts[i].material, static_cast<int>(i));
      EXPECT_LE(level.parts[i].first_index + level.parts[i].index_count, m.indices.size());
    }
    EXPECT_EQ(level.parts[1].first_index, m.parts[1].first_index) << "too small for levels of its own";
  }
}

TEST(Levels, SmallModelsHaveNone) {
  Model m = model_of({sheet(10, on_ball)});
  add_levels(m);
  EXPECT_TRUE(m.levels.empty());
  EXPECT_EQ(m.parts[0].index_count, 600U);
}

}  // namespace
}  // namespace onestroke
