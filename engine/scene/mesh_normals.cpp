#include "scene/mesh_normals.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <utility>

namespace onestroke {

namespace {

using Corners = std::span<const std::uint32_t, 3>;

std::size_t triangle_count(const Surface& s) {
  return s.indices.size() / 3;
}

Corners corners_of(const Surface& s, std::size_t triangle) {
  return Corners(s.indices.data() + 3 * triangle, 3);
}

glm::dvec3 position_of(const Surface& s, std::uint32_t vertex) {
  return glm::make_vec3(s.vertices[vertex].position.data());
}

std::array<float, 3> to_array(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

glm::dvec3 unit_across(const glm::dvec3& n) {
  const glm::dvec3 least = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = least - n * glm::dot(n, least);
  const double length = glm::length(across);
  return length > 0 ? across / length : glm::dvec3(1, 0, 0);
}

// Twice the area of each triangle along its normal, the unit normals, and the triangles about each place.
struct Faces {
  std::vector<glm::dvec3> areas, units;
  std::vector<std::uint32_t> place_of_vertex;
  struct Corner {
    std::uint32_t triangle;
    double angle;
  };
  std::vector<std::vector<Corner>> around_place;
};

void drop_empty_triangles(Surface& s, Faces& f) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangle_count(s); ++t) {
    const Corners c = corners_of(s, t);
    const glm::dvec3 a = position_of(s, c[0]);
    const glm::dvec3 area = glm::cross(position_of(s, c[1]) - a, position_of(s, c[2]) - a);
    const double length = glm::length(area);
    if (!(length > 0)) continue;
    f.areas.push_back(area);
    f.units.push_back(area / length);
    for (std::size_t k = 0; k < 3; ++k) s.indices[3 * kept + k] = s.indices[3 * t + k];
    ++kept;
  }
  s.indices.resize(3 * kept);
}

// The triangle's angle at its corner in the given place; with it the way a flat face is cut up makes no difference.
double corner_angle(const Surface& s, const Faces& f, std::size_t triangle, std::uint32_t place) {
  const Corners c = corners_of(s, triangle);
  std::size_t at = 0;
  while (at < 2 && f.place_of_vertex[c[at]] != place) ++at;
  const glm::dvec3 p = position_of(s, c[at]);
  const glm::dvec3 u = position_of(s, c[(at + 1) % 3]) - p, v = position_of(s, c[(at + 2) % 3]) - p;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

Faces find_faces(Surface& s) {
  Faces f;
  drop_empty_triangles(s, f);
  std::map<std::array<float, 3>, std::uint32_t> places;
  for (const ModelVertex& v : s.vertices)
    f.place_of_vertex.push_back(
        places.try_emplace(v.position, static_cast<std::uint32_t>(places.size())).first->second);
  f.around_place.resize(places.size());
  for (std::size_t t = 0; t < triangle_count(s); ++t)
    for (const std::uint32_t corner : corners_of(s, t)) {
      const std::uint32_t place = f.place_of_vertex[corner];
      f.around_place[place].push_back({static_cast<std::uint32_t>(t), corner_angle(s, f, t, place)});
    }
  return f;
}

std::array<float, 3> corner_normal(const Faces& f, std::size_t triangle, std::uint32_t vertex, double cos_crease) {
  const std::uint32_t place = f.place_of_vertex[vertex];
  glm::dvec3 sum(0);
  for (const Faces::Corner& other : f.around_place[place])
    if (glm::dot(f.units[other.triangle], f.units[triangle]) >= cos_crease)
      sum += other.angle * f.areas[other.triangle];
  const double length = glm::length(sum);
  return to_array(length > 0 ? sum / length : f.units[triangle]);
}

}  // namespace

void compute_normals(Surface& surface, double crease) {
  const Faces faces = find_faces(surface);
  const double cos_crease = std::cos(crease);
  std::vector<ModelVertex> vertices;
  std::map<std::pair<std::uint32_t, std::array<float, 3>>, std::uint32_t> known;
  for (std::size_t i = 0; i < surface.indices.size(); ++i) {
    const std::uint32_t old = surface.indices[i];
    const auto normal = corner_normal(faces, i / 3, old, cos_crease);
    const auto [entry, added] = known.try_emplace({old, normal}, static_cast<std::uint32_t>(vertices.size()));
    if (added) {
      vertices.push_back(surface.vertices[old]);
      vertices.back().normal = normal;
    }
    surface.indices[i] = entry->second;
  }
  surface.vertices = std::move(vertices);
}

namespace {

struct TextureFrame {
  glm::dvec3 tangent;  // Along u, as long as the triangle is large in the texture; zero where there is none.
  bool mirrored;
};

TextureFrame texture_frame(const Surface& s, Corners c) {
  const glm::dvec3 p = position_of(s, c[0]), e1 = position_of(s, c[1]) - p, e2 = position_of(s, c[2]) - p;
  const auto uv = [&](std::size_t k) { return glm::dvec2(glm::make_vec2(s.vertices[c[k]].uv.data())); };
  const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
  const double area = d1.x * d2.y - d2.x * d1.y;
  const glm::dvec3 along = (e1 * d2.y - e2 * d1.y) * (area < 0 ? -1.0 : 1.0);
  // glTF's v grows downwards while the bitangent points up in the texture, so the unmirrored area is the negative one.
  return {std::isfinite(glm::dot(along, along)) ? along : glm::dvec3(0), area > 0};
}

}  // namespace

void compute_tangents(Surface& surface) {
  std::vector<ModelVertex> vertices;
  std::vector<glm::dvec3> sums;
  std::map<std::pair<std::uint32_t, bool>, std::uint32_t> known;
  for (std::size_t t = 0; t < triangle_count(surface); ++t) {
    const TextureFrame frame = texture_frame(surface, corners_of(surface, t));
    for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
      const std::uint32_t old = surface.indices[k];
      const auto [entry, added] = known.try_emplace({old, frame.mirrored}, static_cast<std::uint32_t>(vertices.size()));
      if (added) {
        vertices.push_back(surface.vertices[old]);
        vertices.back().tangent[3] = frame.mirrored ? -1.0F : 1.0F;
        sums.emplace_back(0);
      }
      sums[entry->second] += frame.tangent;
      surface.indices[k] = entry->second;
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::dvec3 n = glm::make_vec3(vertices[i].normal.data());
    const glm::dvec3 across = sums[i] - n * glm::dot(n, sums[i]);
    const double length = glm::length(across);
    const auto unit = to_array(length > 0 ? across / length : unit_across(n));
    for (std::size_t k = 0; k < 3; ++k) vertices[i].tangent[k] = unit[k];
  }
  surface.vertices = std::move(vertices);
}

void fill_tangents(Surface& surface) {
  for (ModelVertex& v : surface.vertices) {
    const auto unit = to_array(unit_across(glm::make_vec3(v.normal.data())));
    v.tangent = {unit[0], unit[1], unit[2], 1};
  }
}

}  // namespace onestroke
