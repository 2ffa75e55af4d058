#include "scene/contact_balls.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

constexpr std::size_t most_points = 4096;
constexpr int rounds = 12;

struct SurfacePoint {
  glm::vec3 position;
  float area;
};

glm::vec3 position_of(const Model& model, std::size_t index) {
  return glm::make_vec3(model.vertices[model.indices[index]].position.data());
}

/// The middles of triangles of the full detail, all or evenly chosen ones.
std::vector<SurfacePoint> surface_points(const Model& model) {
  std::size_t triangles = 0;
  for (const ModelPart& part : model.parts) triangles += part.index_count / 3;
  const std::size_t step = triangles / most_points + 1;
  std::vector<SurfacePoint> points;
  points.reserve(triangles / step + model.parts.size());
  for (const ModelPart& part : model.parts)
    for (std::size_t i = 0; i < part.index_count / 3; i += step) {
      const std::size_t first = part.first_index + 3 * i;
      const glm::vec3 a = position_of(model, first), b = position_of(model, first + 1),
                      c = position_of(model, first + 2);
      points.push_back({(a + b + c) / 3.0F, glm::length(glm::cross(b - a, c - a))});
    }
  return points;
}

std::size_t nearest(const std::vector<glm::vec3>& centres, const glm::vec3& p) {
  const auto closer = [&p](const glm::vec3& a, const glm::vec3& b) {
    return glm::dot(a - p, a - p) < glm::dot(b - p, b - p);
  };
  return static_cast<std::size_t>(std::min_element(centres.begin(), centres.end(), closer) - centres.begin());
}

/// Each the point that is farthest from those before it.
std::vector<glm::vec3> spread_centres(const std::vector<SurfacePoint>& points) {
  std::vector<glm::vec3> centres{points.front().position};
  while (centres.size() < std::min(most_contact_balls, points.size())) {
    const auto distance = [&centres](const SurfacePoint& p) {
      return glm::distance(centres[nearest(centres, p.position)], p.position);
    };
    centres.push_back(std::max_element(points.begin(), points.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
                        return distance(a) < distance(b);
                      })->position);
  }
  return centres;
}

}  // namespace

std::vector<ContactBall> contact_balls(const Model& model) {
  const std::vector<SurfacePoint> points = surface_points(model);
  if (points.empty()) return {};
  std::vector<glm::vec3> centres = spread_centres(points);
  std::vector<float> areas(centres.size()), squares(centres.size());
  for (int round = 0; round < rounds; ++round) {
    std::vector<glm::vec3> sums(centres.size(), glm::vec3(0));
    std::fill(areas.begin(), areas.end(), 0.0F);
    std::fill(squares.begin(), squares.end(), 0.0F);
    for (const SurfacePoint& p : points) {
      const std::size_t i = nearest(centres, p.position);
      sums[i] += p.area * p.position;
      areas[i] += p.area;
      squares[i] += p.area * glm::dot(p.position - centres[i], p.position - centres[i]);
    }
    for (std::size_t i = 0; i < centres.size() && round + 1 < rounds; ++i)
      if (areas[i] > 0) centres[i] = sums[i] / areas[i];
  }
  std::vector<ContactBall> balls;
  for (std::size_t i = 0; i < centres.size(); ++i)
    if (areas[i] > 0) balls.push_back({{centres[i].x, centres[i].y, centres[i].z}, std::sqrt(squares[i] / areas[i])});
  return balls;
}

}  // namespace onestroke
