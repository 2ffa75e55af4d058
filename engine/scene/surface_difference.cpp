#include "scene/surface_difference.h"

#include "scene/surface_sides.h"
#include "scene/triangle_tree.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <future>
#include <numeric>
#include <thread>

namespace onestroke {

namespace {

glm::dvec3 position_of(const ModelVertex& v) {
  return glm::make_vec3(v.position.data());
}

struct Target {
  explicit Target(const Surface& surface) : tree(surface.vertices, surface.indices), sides(surface) {}

  /// `near` is a triangle that may be close, and becomes the nearest.
  double distance(const glm::dvec3& point, std::uint32_t& near) const {
    const TriangleTree::Hit hit = tree.nearest(point, near);
    near = hit.triangle;
    return glm::dot(point - hit.point, sides.normal(hit.triangle, hit.weights)) < 0 ? -hit.distance : hit.distance;
  }

  TriangleTree tree;
  SurfaceSides sides;
};

/// A third of the area of a vertex's triangles.
std::vector<double> areas_about_vertices(const Surface& surface) {
  std::vector<double> areas(surface.vertices.size(), 0);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return position_of(surface.vertices[surface.indices[i + k]]); };
    const double area = glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
    for (std::size_t k = 0; k < 3; ++k) areas[surface.indices[i + k]] += area / 3;
  }
  return areas;
}

void fill_statistics(SurfaceDifference& d, const std::vector<double>& areas) {
  std::vector<std::uint32_t> order;
  double total = 0, sum = 0, squares = 0;
  for (std::uint32_t i = 0; i < areas.size(); ++i) {
    if (areas[i] <= 0) continue;
    const double distance = d.distances[i];
    order.push_back(i);
    total += areas[i];
    sum += areas[i] * distance;
    squares += areas[i] * distance * distance;
    d.most = std::max(d.most, std::abs(distance));
  }
  if (order.empty()) return;
  d.mean = sum / total;
  d.rms = std::sqrt(squares / total);
  std::ranges::sort(order, {}, [&d](std::uint32_t i) { return std::abs(d.distances[i]); });
  double below = 0;
  for (const std::uint32_t i : order) {
    d.p95 = std::abs(double{d.distances[i]});
    below += areas[i];
    if (below >= 0.95 * total) break;
  }
}

/// Places that are close in the list are close in space: the vertices in the order in which triangles use them.
std::vector<std::uint32_t> order_of_use(const Surface& surface) {
  std::vector<std::uint32_t> order;
  std::vector<bool> known(surface.vertices.size());
  for (const std::uint32_t i : surface.indices)
    if (!known[i]) {
      known[i] = true;
      order.push_back(i);
    }
  return order;
}

class Measurement {
 public:
  Measurement(const Surface& own, const Target& target, const glm::dmat4& other_from_own, std::vector<float>& distances)
      : own_(own), target_(target), other_from_own_(other_from_own), order_(order_of_use(own)), distances_(distances) {}

  void run(const DifferenceOptions& options) {
    const int count = std::max(options.threads, 1);
    std::vector<std::jthread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back([this](const std::stop_token& stop) { work(stop); });
    // The threads are told to stop where this throws.
    while (done_ < order_.size()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      if (options.progress) options.progress(static_cast<double>(done_) / static_cast<double>(order_.size()));
    }
  }

 private:
  static constexpr std::size_t batch = 1024;

  void work(const std::stop_token& stop) {
    std::uint32_t near = 0;
    while (!stop.stop_requested()) {
      const std::size_t first = next_.fetch_add(batch);
      if (first >= order_.size()) return;
      const std::size_t end = std::min(first + batch, order_.size());
      for (std::size_t i = first; i < end; ++i) {
        const std::uint32_t v = order_[i];
        const glm::dvec3 point(other_from_own_ * glm::dvec4(position_of(own_.vertices[v]), 1.0));
        distances_[v] = static_cast<float>(target_.distance(point, near));
      }
      done_ += end - first;
    }
  }

  const Surface& own_;
  const Target& target_;
  const glm::dmat4 other_from_own_;
  const std::vector<std::uint32_t> order_;
  std::vector<float>& distances_;
  std::atomic<std::size_t> next_{0}, done_{0};
};

SurfaceMeasures measures_of(const Surface& surface, bool closed) {
  SurfaceMeasures m{.closed = closed};
  // From a point of the surface, so that what is far from the origin loses nothing to rounding.
  const glm::dvec3 origin = position_of(surface.vertices[surface.indices.front()]);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return position_of(surface.vertices[surface.indices[i + k]]) - origin; };
    const glm::dvec3 across = glm::cross(at(1) - at(0), at(2) - at(0));
    m.area += glm::length(across) / 2;
    m.volume += glm::dot(at(0), across) / 6;
  }
  return m;
}

}  // namespace

SurfaceMeasures measure(const Surface& surface) {
  return measures_of(surface, SurfaceSides(surface).closed());
}

SurfaceDifference measure_difference(const Surface& own, const Surface& other, const glm::dmat4& other_from_own,
                                     const DifferenceOptions& options) {
  auto measured =
      std::async(options.threads > 1 ? std::launch::async : std::launch::deferred, [&own] { return measure(own); });
  const Target target(other);
  SurfaceDifference difference;
  difference.distances.resize(own.vertices.size());
  difference.own = measured.get();
  difference.other = measures_of(other, target.sides.closed());
  Measurement(own, target, other_from_own, difference.distances).run(options);
  fill_statistics(difference, areas_about_vertices(own));
  if (options.progress) options.progress(1);
  return difference;
}

}  // namespace onestroke
