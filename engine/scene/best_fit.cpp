#include "scene/best_fit.h"

#include "scene/surface_sides.h"
#include "scene/triangle_tree.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

namespace onestroke {

namespace {

constexpr std::size_t sample_count = 4000;
constexpr double tukey = 4.685;   // Residuals of so many deviations count for nothing (95 % efficiency).
constexpr double as_good = 1.02;  // No better than that is as good.

/// How thoroughly a fit is made.
struct Effort {
  std::size_t every = 1;  // How many of the points count.
  int most_rounds = 80;
  double still = 1e-7;  // Of the surface's size: what moves less has settled.
};
constexpr Effort rough{.every = 8, .most_rounds = 40, .still = 1e-3}, thorough{};

using Row = std::array<double, 6>;

/// Points of a surface, evenly spread over its area.
std::vector<glm::dvec3> sample(const Surface& surface) {
  const auto at = [&](std::size_t i) {
    return glm::dvec3(glm::make_vec3(surface.vertices[surface.indices[i]].position.data()));
  };
  std::vector<double> below;
  double area = 0;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3)
    below.push_back(area += glm::length(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i))));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<glm::dvec3> points;
  for (std::size_t k = 0; k < sample_count; ++k) {
    // One in every equal piece of the area.
    const double place = area * (static_cast<double>(k) + share(random)) / sample_count;
    const auto found = std::upper_bound(below.begin(), below.end() - 1, place);
    const std::size_t i = 3 * static_cast<std::size_t>(found - below.begin());
    double a = share(random), b = share(random);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    points.push_back(at(i) + a * (at(i + 1) - at(i)) + b * (at(i + 2) - at(i)));
  }
  return points;
}

/// Symmetric, positive definite but for rounding; by Cholesky's factors. None where a direction is free.
std::optional<Row> solve(std::array<Row, 6> m, Row y) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= m[i][k] * m[j][k];
      if (i == j) {
        if (!(sum > 1e-12 * m[i][i])) return std::nullopt;
        m[i][i] = std::sqrt(sum);
      } else {
        m[i][j] = sum / m[j][j];
      }
    }
    for (std::size_t k = 0; k < i; ++k) y[i] -= m[i][k] * y[k];
    y[i] /= m[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) y[i] -= m[k][i] * y[k];
    y[i] /= m[i][i];
  }
  return y;
}

struct Body {
  glm::dvec3 middle{0.0};
  glm::dmat3 axes{1.0};  // columns, right-handed, the longest first
  double size = 0;
};

/// The eigenvectors of a symmetric matrix as columns, by Jacobi's turns.
glm::dmat3 eigenvectors(glm::dmat3 m) {
  glm::dmat3 vectors(1.0);
  for (int sweep = 0; sweep < 30; ++sweep)
    for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      if (m[p][q] == 0) continue;
      const double angle = std::atan2(2 * m[p][q], m[q][q] - m[p][p]) / 2, c = std::cos(angle), s = std::sin(angle);
      glm::dmat3 turn(1.0);
      turn[p][p] = turn[q][q] = c;
      turn[p][q] = -s;
      turn[q][p] = s;
      m = glm::transpose(turn) * m * turn;
      vectors = vectors * turn;
    }
  return vectors;
}

Body body_of(const std::vector<glm::dvec3>& points) {
  Body body;
  for (const auto& p : points) body.middle += p / static_cast<double>(points.size());
  glm::dmat3 spread(0.0);
  for (const auto& p : points) spread += glm::outerProduct(p - body.middle, p - body.middle);
  const glm::dmat3 vectors = eigenvectors(spread);
  std::array<std::pair<double, glm::dvec3>, 3> sorted;
  for (int i = 0; i < 3; ++i)
    sorted[static_cast<std::size_t>(i)] = {glm::dot(vectors[i], spread * vectors[i]), vectors[i]};
  std::ranges::sort(sorted, [](const auto& a, const auto& b) { return a.first > b.first; });
  body.axes = {sorted[0].second, sorted[1].second, glm::cross(sorted[0].second, sorted[1].second)};
  body.size = std::sqrt((sorted[0].first + sorted[1].first + sorted[2].first) / static_cast<double>(points.size()));
  return body;
}

class Fitter {
 public:
  Fitter(const Surface& own, const Surface& other)
      : points_(sample(own)), tree_(other.vertices, other.indices), sides_(other), body_(body_of(points_)) {}

  const Body& body() const { return body_; }

  BestFit fit(const glm::dmat4& start, const Effort& effort) {
    BestFit best{.other_from_own = start};
    near_.assign(points_.size(), 0);
    for (int round = 0; round < effort.most_rounds && !best.settled; ++round) {
      const auto step = this->step(best, effort.every);
      if (!step) break;
      best.settled = length_of(*step) < effort.still * body_.size;
      best.other_from_own = moved(best.other_from_own, *step);
    }
    return best;
  }

 private:
  struct Pair {
    glm::dvec3 point, normal;
    double off = 0;
  };

  /// Fills in the fit's rms. None where the surfaces slide on each other freely.
  std::optional<Row> step(BestFit& best, std::size_t every) {
    pairs_.clear();
    std::vector<double> sizes;
    for (std::size_t i = 0; i < points_.size(); i += every) {
      const glm::dvec3 p(best.other_from_own * glm::dvec4(points_[i], 1.0));
      const TriangleTree::Hit hit = tree_.nearest(p, near_[i]);
      near_[i] = hit.triangle;
      const glm::dvec3 normal = sides_.normal(hit.triangle, hit.weights);
      const double length = glm::length(normal);
      if (!(length > 0)) continue;
      const double side = glm::dot(p - hit.point, normal) < 0 ? -1 : 1;
      // Off an edge or a corner the nearest point is not on a plane's side: the line to it stands for the normal.
      const glm::dvec3 along = hit.distance > 0 ? side * (p - hit.point) / hit.distance : normal / length;
      pairs_.push_back({p - pivot(best), along, side * hit.distance});
      sizes.push_back(hit.distance);
    }
    if (pairs_.size() < 6) return std::nullopt;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double reach = tukey * std::max(*middle / 0.6745, 1e-9 * body_.size);
    return solve_weighted(best, reach);
  }

  std::optional<Row> solve_weighted(BestFit& best, double reach) const {
    std::array<Row, 6> squares{};
    Row sums{};
    double weights = 0, off2 = 0;
    for (const Pair& pair : pairs_) {
      const double share = pair.off / reach, w = std::abs(share) < 1 ? std::pow(1 - share * share, 2) : 0;
      const glm::dvec3 turn = glm::cross(pair.point, pair.normal) / body_.size;
      const Row row{turn.x, turn.y, turn.z, pair.normal.x, pair.normal.y, pair.normal.z};
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j <= i; ++j) squares[i][j] += w * row[i] * row[j];
        sums[i] -= w * row[i] * pair.off;
      }
      weights += w;
      off2 += w * pair.off * pair.off;
    }
    best.rms = std::sqrt(off2 / weights);
    // What nothing holds, as a turn about the axis of a round part, stays as it is.
    for (std::size_t i = 0; i < 6; ++i) squares[i][i] += 1e-6 * weights;
    return solve(squares, sums);
  }

  glm::dvec3 pivot(const BestFit& best) const {
    return glm::dvec3(best.other_from_own * glm::dvec4(body_.middle, 1.0));
  }

  static double length_of(const Row& step) {
    double sum = 0;
    for (const double x : step) sum += x * x;
    return std::sqrt(sum);
  }

  /// Turned about the body's middle, then shifted.
  glm::dmat4 moved(const glm::dmat4& m, const Row& step) const {
    const glm::dvec3 pivot(m * glm::dvec4(body_.middle, 1.0));
    const glm::dvec3 turn = glm::dvec3(step[0], step[1], step[2]) / body_.size, shift(step[3], step[4], step[5]);
    const double angle = glm::length(turn);
    glm::dmat4 change = glm::translate(glm::dmat4(1.0), pivot + shift);
    if (angle > 0) change = glm::rotate(change, angle, turn / angle);
    return glm::translate(change, -pivot) * m;
  }

  const std::vector<glm::dvec3> points_;
  const TriangleTree tree_;
  const SurfaceSides sides_;
  const Body body_;
  std::vector<std::uint32_t> near_;
  std::vector<Pair> pairs_;
};

glm::dmat4 on_each_other(const Body& own, const Body& other, bool turn_first, bool turn_second) {
  const double a = turn_first ? -1 : 1, b = turn_second ? -1 : 1;
  const glm::dmat3 turned{a * own.axes[0], b * own.axes[1], a * b * own.axes[2]};
  const glm::dmat3 rotation = other.axes * glm::transpose(turned);
  glm::dmat4 m(rotation);
  m[3] = glm::dvec4(other.middle - rotation * own.middle, 1.0);
  return m;
}

}  // namespace

BestFit best_fit(const Surface& own, const Surface& other) {
  Fitter fitter(own, other);
  BestFit best = fitter.fit(glm::dmat4(1.0), rough);
  const Body target = body_of(sample(other));
  for (const bool first : {false, true})
    for (const bool second : {false, true}) {
      const BestFit next = fitter.fit(on_each_other(fitter.body(), target, first, second), rough);
      if (next.rms * as_good < best.rms) best = next;
    }
  return fitter.fit(best.other_from_own, thorough);
}

}  // namespace onestroke
