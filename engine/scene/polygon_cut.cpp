#include "scene/polygon_cut.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vec2.hpp>

#include <cmath>

namespace onestroke {

namespace {

// The time grows with the square of the corners and more; what has more of them is cut like a fan.
constexpr std::size_t most_corners = 300;

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

// A polygon laid into its own plane, where it turns to the left, losing one ear after another.
class Ears {
 public:
  Ears(const std::vector<ModelVertex>& vertices, std::span<const std::uint32_t> corners)
      : left_(corners.begin(), corners.end()) {
    std::vector<glm::dvec3> points;
    for (const std::uint32_t i : corners) points.emplace_back(glm::make_vec3(vertices[i].position.data()));
    glm::dvec3 normal(0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      normal += glm::cross(points[i] - points[0], points[i + 1] - points[0]);
    // Seen along the normal's largest part.
    const glm::dvec3 size = glm::abs(normal);
    const glm::length_t drop = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    for (const glm::dvec3& p : points) {
      const glm::dvec2 q(p[(drop + 1) % 3], p[(drop + 2) % 3]);
      flat_.push_back(normal[drop] < 0 ? glm::dvec2(q.y, q.x) : q);
    }
  }

  void cut(std::vector<std::uint32_t>& triangles) {
    while (left_.size() > 3) {
      std::size_t ear = 0;
      while (ear < left_.size() && !is_ear(ear)) ++ear;
      // Without one it crosses itself or has no area: any corner will do.
      take(ear < left_.size() ? ear : 0, triangles);
    }
    triangles.insert(triangles.end(), left_.begin(), left_.end());
  }

 private:
  std::size_t before(std::size_t i) const { return (i + left_.size() - 1) % left_.size(); }
  std::size_t after(std::size_t i) const { return (i + 1) % left_.size(); }

  bool is_ear(std::size_t i) const {
    const glm::dvec2 &a = flat_[before(i)], &b = flat_[i], &c = flat_[after(i)];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t k = 0; k < flat_.size(); ++k) {
      const glm::dvec2& p = flat_[k];
      if (k == i || k == before(i) || k == after(i) || p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  void take(std::size_t i, std::vector<std::uint32_t>& triangles) {
    triangles.insert(triangles.end(), {left_[before(i)], left_[i], left_[after(i)]});
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
    flat_.erase(flat_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  std::vector<std::uint32_t> left_;
  std::vector<glm::dvec2> flat_;  // one a corner that is left
};

}  // namespace

void cut_polygon(const std::vector<ModelVertex>& vertices, std::span<const std::uint32_t> corners,
                 std::vector<std::uint32_t>& triangles) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    triangles.insert(triangles.end(), corners.begin(), corners.end());
  } else if (corners.size() <= most_corners) {
    Ears(vertices, corners).cut(triangles);
  } else {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      triangles.insert(triangles.end(), {corners[0], corners[i], corners[i + 1]});
  }
}

}  // namespace onestroke
