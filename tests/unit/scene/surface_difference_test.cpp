#include "scene/surface_difference.h"

#include "scene/surface_sides.h"
#include "solid_surfaces.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace onestroke {
namespace {

/// Triangles that nobody would call a surface, for their corners alone.
Surface scattered(std::mt19937& random, double reach, int count) {
  std::uniform_real_distribution<double> anywhere(-reach, reach);
  Surface s;
  for (int i = 0; i < 3 * count; ++i) {
    add_vertex(s, {anywhere(random), anywhere(random), anywhere(random)});
    s.indices.push_back(static_cast<std::uint32_t>(i));
  }
  return s;
}

TEST(SurfaceDifference, IsTheDistanceFromABox) {
  std::mt19937 random(1);
  const glm::dvec3 half(0.5, 0.25, 0.125);
  const Surface cloud = scattered(random, 0.7, 2000);
  for (const int n : {1, 7}) {
    const SurfaceDifference d = measure_difference(cloud, box(half, n), glm::dmat4(1));
    ASSERT_EQ(d.distances.size(), cloud.vertices.size());
    for (std::size_t i = 0; i < d.distances.size(); ++i)
      ASSERT_NEAR(d.distances[i], distance_to_box(position(cloud, i), half), 1e-6) << i;
  }
}

TEST(SurfaceDifference, GoesWithTheOtherSurface) {
  std::mt19937 random(2);
  const glm::dvec3 half(0.5, 0.25, 0.125);
  const Surface cloud = scattered(random, 0.7, 500);
  const glm::dmat4 turned =
      glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.1, -0.2, 0.3)), 1.1, glm::normalize(glm::dvec3(1, 2, 3)));
  const SurfaceDifference d = measure_difference(cloud, box(half, 3), turned);
  for (std::size_t i = 0; i < d.distances.size(); ++i)
    ASSERT_NEAR(d.distances[i], distance_to_box(glm::dvec3(turned * glm::dvec4(position(cloud, i), 1.0)), half), 1e-6);
}

// Where a face's own normal would tell the wrong side: beyond an acute edge the nearest point is on the edge, and some
// of the points that it is nearest to lie behind one of its faces.
TEST(SurfaceDifference, KnowsTheSideAtEdgesAndCorners) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int round = 0; round < 50; ++round) {
    std::array<glm::dvec3, 4> p;
    for (auto& c : p) c = {anywhere(random), anywhere(random), 0.1 * anywhere(random)};
    if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) > 0) std::swap(p[0], p[1]);
    Surface wedge;
    for (const auto& c : p) add_vertex(wedge, c);
    wedge.indices = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    const Surface cloud = scattered(random, 1.2, 200);
    const SurfaceDifference d = measure_difference(cloud, wedge, glm::dmat4(1));
    EXPECT_TRUE(d.other.closed);
    for (std::size_t i = 0; i < cloud.vertices.size(); ++i) {
      double outside = -1;
      for (std::size_t t = 0; t < 12; t += 3) {
        const auto at = [&](std::size_t k) { return position(wedge, wedge.indices[t + k]); };
        const glm::dvec3 n = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
        outside = std::max(outside, glm::dot(n, position(cloud, i) - at(0)));
      }
      if (std::abs(outside) < 1e-6) continue;
      ASSERT_EQ(d.distances[i] > 0, outside > 0) << round << " " << i;
    }
  }
}

TEST(SurfaceDifference, OfABallFromALargerOneIsWhatTheRadiiSay) {
  const SurfaceDifference d = measure_difference(ball(1.02, 60), ball(1, 200), glm::dmat4(1));
  // Facets lie inside the ball that their corners lie on, by an eighth of the square of their length.
  EXPECT_NEAR(d.mean, 0.02, 5e-5);
  EXPECT_NEAR(d.rms, 0.02, 5e-5);
  EXPECT_NEAR(d.most, 0.02, 1e-4);
  EXPECT_TRUE(d.own.closed && d.other.closed);
  EXPECT_NEAR(d.own.volume / d.other.volume, std::pow(1.02, 3), 2e-3);
  EXPECT_NEAR(d.other.area, 4 * std::numbers::pi, 1e-3);
  EXPECT_NEAR(d.other.volume, 4 * std::numbers::pi / 3, 1e-3);
}

TEST(SurfaceDifference, ForgivesTrianglesWithoutArea) {
  std::mt19937 random(6);
  const glm::dvec3 half(0.5, 0.25, 0.125);
  Surface other = box(half, 3);
  // Folded up to a point, to a side, and with its three corners on a line; also first, where a search begins.
  const std::vector<std::uint32_t> flat{0, 0, 0, 0, 0, 1, 0, 1, 2};
  other.indices.insert(other.indices.begin(), flat.begin(), flat.end());
  const Surface cloud = scattered(random, 0.7, 500);
  const SurfaceDifference d = measure_difference(cloud, other, glm::dmat4(1));
  for (std::size_t i = 0; i < d.distances.size(); ++i)
    ASSERT_NEAR(d.distances[i], distance_to_box(position(cloud, i), half), 1e-6) << i;
  other.indices.erase(other.indices.begin() + 6, other.indices.begin() + 9);
  EXPECT_TRUE(measure(other).closed);
}

TEST(SurfaceDifference, CountsByArea) {
  // One large sheet at 1 from the other, one a tenth as large at 3.
  Surface own, other;
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0);
  add_face(own, {0, 0, 1}, x, y, 1);
  add_face(own, {10, 0, 3}, 0.1 * x, y, 8);
  add_face(other, {5, 0, 0}, 10.0 * x, 10.0 * y, 2);
  const SurfaceDifference d = measure_difference(own, other, glm::dmat4(1));
  EXPECT_NEAR(d.mean, (10 * 1 + 3) / 11.0, 1e-6);
  EXPECT_NEAR(d.rms, std::sqrt((10 * 1 + 9) / 11.0), 1e-6);
  EXPECT_NEAR(d.p95, 3, 1e-6);
  EXPECT_NEAR(d.most, 3, 1e-6);
  EXPECT_FALSE(d.own.closed);
  EXPECT_NEAR(d.own.area, 4.4, 1e-5);
}

TEST(SurfaceDifference, MeasuresABox) {
  const SurfaceMeasures m = measure(box({0.5, 0.25, 0.125}, 4));
  EXPECT_TRUE(m.closed);
  EXPECT_NEAR(m.volume, 0.125, 1e-7);
  EXPECT_NEAR(m.area, 2 * (1 * 0.5 + 1 * 0.25 + 0.5 * 0.25), 1e-6);
}

TEST(SurfaceDifference, TakesPartsThatTouchForClosed) {
  const SurfaceMeasures along_an_edge = measure(cubes(0.5, {2, 2, 1}, [](const Cell& c) { return c.x == c.y; }));
  EXPECT_TRUE(along_an_edge.closed);
  EXPECT_NEAR(along_an_edge.volume, 0.25, 1e-9);
  Surface side_by_side = box({0.5, 0.5, 0.5}, 2), more = side_by_side;
  for (ModelVertex& v : more.vertices) v.position[0] += 1;
  append(more, side_by_side);
  EXPECT_TRUE(measure(side_by_side).closed);
  side_by_side.indices.resize(side_by_side.indices.size() - 3);
  EXPECT_FALSE(measure(side_by_side).closed);
}

TEST(SurfaceDifference, IsTheSameWithManyThreads) {
  std::mt19937 random(4);
  const Surface cloud = scattered(random, 0.7, 4000), other = box({0.5, 0.25, 0.125}, 9);
  const SurfaceDifference one = measure_difference(cloud, other, glm::dmat4(1));
  double before = 0;
  const SurfaceDifference many =
      measure_difference(cloud, other, glm::dmat4(1), {.threads = 4, .progress = [&](double p) {
                                                         EXPECT_GE(p, before);
                                                         before = p;
                                                       }});
  EXPECT_EQ(before, 1);
  EXPECT_EQ(many.distances, one.distances);
  EXPECT_EQ(many.p95, one.p95);
}

TEST(SurfaceDifference, EndsWhereItsProgressThrows) {
  std::mt19937 random(5);
  const Surface cloud = scattered(random, 0.7, 200'000), other = box({0.5, 0.25, 0.125}, 9);
  const auto stop = [](double) { throw std::runtime_error("no longer wanted"); };
  EXPECT_THROW(measure_difference(cloud, other, glm::dmat4(1), {.threads = 2, .progress = stop}), std::runtime_error);
}

}  // namespace
}  // namespace onestroke
