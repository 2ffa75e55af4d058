#include "scene/best_fit.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace onestroke {
namespace {

/// A body without symmetries. `dent`: a part of it is another shape.
Surface pebble(int n, bool dent) {
  Surface s;
  for (int i = 0; i <= 2 * n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double a = i == 2 * n ? 0 : std::numbers::pi * i / n, b = std::numbers::pi * j / n;
      const glm::dvec3 d(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
      double r = 1 + 0.15 * d.x * d.y + 0.1 * d.z * d.z * d.x + 0.05 * std::sin(4 * d.x + 2 * d.y);
      if (dent && d.x > 0.7) r += 0.4 * (d.x - 0.7);
      const glm::dvec3 p = r * d * glm::dvec3(0.05, 0.03, 0.02);
      s.vertices.push_back({.position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                            .normal = {},
                            .tangent = {},
                            .uv = {},
                            .color = {}});
    }
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::uint32_t i = 0; i < 2 * static_cast<std::uint32_t>(n); ++i)
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = i * row + j;
      s.indices.insert(s.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
    }
  return s;
}

Surface moved(Surface s, const glm::dmat4& m) {
  for (ModelVertex& v : s.vertices) {
    const glm::dvec4 p = m * glm::dvec4(v.position[0], v.position[1], v.position[2], 1.0);
    v.position = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  return s;
}

/// How far a fit leaves the corners of a box round the body from where they belong.
double off(const glm::dmat4& fitted, const glm::dmat4& truth) {
  double most = 0;
  for (const double x : {-0.05, 0.05})
    for (const double y : {-0.03, 0.03})
      most = std::max(most, glm::distance(glm::dvec3(fitted * glm::dvec4(x, y, 0.02, 1)),
                                          glm::dvec3(truth * glm::dvec4(x, y, 0.02, 1))));
  return most;
}

glm::dmat4 turn_and_shift(std::mt19937& random, double turn, double shift) {
  std::uniform_real_distribution<double> anywhere(-1, 1);
  const auto direction = [&] {
    return glm::normalize(glm::dvec3(anywhere(random), anywhere(random), anywhere(random)));
  };
  return glm::rotate(glm::translate(glm::dmat4(1), shift * direction()), turn, direction());
}

TEST(BestFit, FindsASmallShiftToTheLast) {
  std::mt19937 random(1);
  const Surface body = pebble(80, false);
  for (int i = 0; i < 5; ++i) {
    const glm::dmat4 truth = turn_and_shift(random, 0.1, 0.004);
    const BestFit fit = best_fit(pebble(60, false), moved(body, truth));
    EXPECT_TRUE(fit.settled);
    EXPECT_LT(off(fit.other_from_own, truth), 2e-5);
    EXPECT_LT(fit.rms, 2e-5);
  }
}

TEST(BestFit, FindsAnyTurn) {
  std::mt19937 random(2);
  const Surface body = pebble(80, false);
  for (int i = 0; i < 8; ++i) {
    const glm::dmat4 truth = turn_and_shift(random, 3.0 * i / 7, 0.3);
    const BestFit fit = best_fit(pebble(60, false), moved(body, truth));
    EXPECT_LT(off(fit.other_from_own, truth), 2e-5) << i;
  }
}

TEST(BestFit, IsNotMovedByWhatWasChanged) {
  std::mt19937 random(3);
  const glm::dmat4 truth = turn_and_shift(random, 0.05, 0.002);
  const BestFit fit = best_fit(pebble(60, true), moved(pebble(80, false), truth));
  EXPECT_LT(off(fit.other_from_own, truth), 1e-4);
}

TEST(BestFit, TurnsWhatIsRoundNoFurtherThanItHasTo) {
  const auto ball = [](double middle) {
    Surface s = pebble(60, false);
    for (ModelVertex& v : s.vertices) {
      const glm::dvec3 p = 0.03 * glm::normalize(glm::dvec3(v.position[0], v.position[1], v.position[2]));
      v.position = {static_cast<float>(p.x + middle), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    return s;
  };
  const BestFit fit = best_fit(ball(0), ball(0.01));
  EXPECT_LT(off(fit.other_from_own, glm::translate(glm::dmat4(1), glm::dvec3(0.01, 0, 0))), 1e-3);
}

}  // namespace
}  // namespace onestroke
