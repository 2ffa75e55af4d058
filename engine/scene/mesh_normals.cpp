#include "scene/mesh_normals.h"

#include "scene/mesh_weld.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
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
  Places places;
  struct Corner {
    std::uint32_t triangle;
    double angle;
  };
  std::vector<Corner> corners;     // Those of a place follow one another,
  std::vector<std::size_t> first;  // the first of them here; one more number at the end.

  std::span<const Corner> around(std::uint32_t place) const {
    return std::span(corners).subspan(first[place], first[place + 1] - first[place]);
  }
};

glm::dvec3 area_of(const Surface& s, Corners c) {
  const glm::dvec3 a = position_of(s, c[0]);
  return glm::cross(position_of(s, c[1]) - a, position_of(s, c[2]) - a);
}

// The triangle's angle at a corner; with it the way a flat face is cut up makes no difference.
double corner_angle(const Surface& s, Corners c, std::size_t at) {
  const glm::dvec3 p = position_of(s, c[at]);
  const glm::dvec3 u = position_of(s, c[(at + 1) % 3]) - p, v = position_of(s, c[(at + 2) % 3]) - p;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

Faces find_faces(const Surface& s) {
  Faces f;
  for (std::size_t t = 0; t < triangle_count(s); ++t) {
    f.areas.push_back(area_of(s, corners_of(s, t)));
    f.units.push_back(f.areas.back() / glm::length(f.areas.back()));
  }
  f.places = find_places(s);
  f.first.assign(f.places.count + 2, 0);
  for (const std::uint32_t vertex : s.indices) ++f.first[f.places.of_vertex[vertex] + 2];
  for (std::size_t i = 2; i < f.first.size(); ++i) f.first[i] += f.first[i - 1];
  // first[place + 1] is where the next corner goes, and in the end where the place after it begins.
  f.corners.resize(s.indices.size());
  for (std::size_t i = 0; i < s.indices.size(); ++i) {
    const std::size_t at = f.first[f.places.of_vertex[s.indices[i]] + 1]++;
    f.corners[at] = {static_cast<std::uint32_t>(i / 3), corner_angle(s, corners_of(s, i / 3), i % 3)};
  }
  f.first.pop_back();
  return f;
}

std::array<float, 3> corner_normal(const Faces& f, std::size_t triangle, std::uint32_t vertex, double cos_crease) {
  glm::dvec3 sum(0);
  for (const Faces::Corner& other : f.around(f.places.of_vertex[vertex]))
    if (glm::dot(f.units[other.triangle], f.units[triangle]) >= cos_crease)
      sum += other.angle * f.areas[other.triangle];
  const double length = glm::length(sum);
  return to_array(length > 0 ? sum / length : f.units[triangle]);
}

// The vertices made out of each old one, so that a corner finds the one that is equal to its own.
class Splits {
 public:
  explicit Splits(std::size_t old) : newest_(old, none) {}

  // `equal` says whether a vertex made before will do; otherwise `vertex` is added.
  template <class Equal>
  std::uint32_t find_or_add(std::uint32_t old, const ModelVertex& vertex, Equal equal) {
    for (std::uint32_t i = newest_[old]; i != none; i = before_[i])
      if (equal(vertices_[i])) return i;
    vertices_.push_back(vertex);
    before_.push_back(newest_[old]);
    return newest_[old] = static_cast<std::uint32_t>(vertices_.size() - 1);
  }
  std::vector<ModelVertex>&& take() { return std::move(vertices_); }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> newest_, before_;
  std::vector<ModelVertex> vertices_;
};

}  // namespace

void drop_empty_triangles(Surface& s) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangle_count(s); ++t) {
    const double length = glm::length(area_of(s, corners_of(s, t)));
    // Not what overflows either.
    if (!(length > 0) || !std::isfinite(length)) continue;
    for (std::size_t k = 0; k < 3; ++k) s.indices[3 * kept + k] = s.indices[3 * t + k];
    ++kept;
  }
  s.indices.resize(3 * kept);
}

bool make_normals_unit(std::vector<ModelVertex>& vertices) {
  for (ModelVertex& v : vertices) {
    const glm::dvec3 n = glm::make_vec3(v.normal.data());
    const double length = glm::length(n);
    if (!(length > 1e-6) || !std::isfinite(length)) return false;
    for (std::size_t k = 0; k < 3; ++k) v.normal[k] = static_cast<float>(double{v.normal[k]} / length);
  }
  return true;
}

void compute_normals(Surface& surface, double crease) {
  drop_empty_triangles(surface);
  const Faces faces = find_faces(surface);
  const double cos_crease = std::cos(crease);
  Splits splits(surface.vertices.size());
  for (std::size_t i = 0; i < surface.indices.size(); ++i) {
    const std::uint32_t old = surface.indices[i];
    ModelVertex vertex = surface.vertices[old];
    vertex.normal = corner_normal(faces, i / 3, old, cos_crease);
    surface.indices[i] =
        splits.find_or_add(old, vertex, [&](const ModelVertex& v) { return v.normal == vertex.normal; });
  }
  surface.vertices = splits.take();
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
  Splits splits(surface.vertices.size());
  std::vector<glm::dvec3> sums;
  for (std::size_t t = 0; t < triangle_count(surface); ++t) {
    const TextureFrame frame = texture_frame(surface, corners_of(surface, t));
    const float side = frame.mirrored ? -1.0F : 1.0F;
    for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
      const std::uint32_t old = surface.indices[k];
      ModelVertex vertex = surface.vertices[old];
      vertex.tangent[3] = side;
      const std::uint32_t at =
          splits.find_or_add(old, vertex, [&](const ModelVertex& v) { return v.tangent[3] == side; });
      if (at == sums.size()) sums.emplace_back(0);
      sums[at] += frame.tangent;
      surface.indices[k] = at;
    }
  }
  surface.vertices = splits.take();
  for (std::size_t i = 0; i < sums.size(); ++i) {
    ModelVertex& v = surface.vertices[i];
    const glm::dvec3 n = glm::make_vec3(v.normal.data());
    const glm::dvec3 across = sums[i] - n * glm::dot(n, sums[i]);
    const double length = glm::length(across);
    const auto unit = to_array(length > 0 ? across / length : unit_across(n));
    for (std::size_t k = 0; k < 3; ++k) v.tangent[k] = unit[k];
  }
}

void fill_tangents(Surface& surface) {
  for (ModelVertex& v : surface.vertices) {
    const auto unit = to_array(unit_across(glm::make_vec3(v.normal.data())));
    v.tangent = {unit[0], unit[1], unit[2], 1};
  }
}

void append(const Surface& more, Surface& all) {
  const auto base = static_cast<std::uint32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const std::uint32_t i : more.indices) all.indices.push_back(base + i);
}

}  // namespace onestroke
