#include "scene/mesh_refinement.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

namespace onestroke {
namespace {

using Indices = std::vector<std::uint32_t>;

// From one try to the next, where there would be too many triangles.
constexpr double longer = 1.25;

template <std::size_t N>
std::array<float, N> mean(const std::array<float, N>& a, const std::array<float, N>& b) {
  std::array<float, N> m;
  // Halves first: no sum of two is too large for a float.
  for (std::size_t i = 0; i < N; ++i) m[i] = a[i] / 2 + b[i] / 2;
  return m;
}

void make_unit(float* vector, const std::array<float, 3>& otherwise) {
  const glm::vec3 v = glm::make_vec3(vector);
  const float length = glm::length(v);
  const glm::vec3 unit = length > 0 ? v / length : glm::make_vec3(otherwise.data());
  std::copy_n(glm::value_ptr(unit), 3, vector);
}

ModelVertex between(const ModelVertex& a, const ModelVertex& b) {
  ModelVertex m{.position = mean(a.position, b.position),
                .normal = mean(a.normal, b.normal),
                .tangent = mean(a.tangent, b.tangent),
                .uv = mean(a.uv, b.uv),
                .color = mean(a.color, b.color)};
  make_unit(m.normal.data(), a.normal);
  make_unit(m.tangent.data(), {a.tangent[0], a.tangent[1], a.tangent[2]});
  m.tangent[3] = a.tangent[3];
  return m;
}

class Refiner {
 public:
  Refiner(const Surface& surface, double longest_edge) : surface_(surface), longest2_(longest_edge * longest_edge) {}

  /// None where there would be more triangles.
  std::optional<Surface> run(std::size_t most_triangles) {
    for (std::size_t before = 0; surface_.indices.size() != before;) {
      before = surface_.indices.size();
      cut_all();
      if (surface_.indices.size() / 3 > most_triangles) return std::nullopt;
    }
    return std::move(surface_);
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  glm::dvec3 at(std::uint32_t v) const { return glm::make_vec3(surface_.vertices[v].position.data()); }
  double length2(std::uint32_t a, std::uint32_t b) const {
    const glm::dvec3 edge = at(a) - at(b);
    return glm::dot(edge, edge);
  }

  void cut_all() {
    cut_.clear();
    middles_.clear();
    for (std::size_t i = 0; i < surface_.indices.size(); i += 3)
      cut(surface_.indices[i], surface_.indices[i + 1], surface_.indices[i + 2]);
    surface_.indices.swap(cut_);
  }

  /// The vertex that halves an edge; none where the edge is short.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    if (!(length2(a, b) > longest2_)) return none;
    const auto [known, is_new] = middles_.try_emplace(std::uint64_t{std::min(a, b)} << 32U | std::max(a, b),
                                                      static_cast<std::uint32_t>(surface_.vertices.size()));
    if (is_new) surface_.vertices.push_back(between(surface_.vertices[a], surface_.vertices[b]));
    return known->second;
  }

  void cut(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const int halved = (ab != none) + (bc != none) + (ca != none);
    if (halved == 0) add(a, b, c);
    if (halved == 1) ab != none ? in_two(a, ab, b, c) : bc != none ? in_two(b, bc, c, a) : in_two(c, ca, a, b);
    if (halved == 2)
      ab == none ? in_three(a, b, bc, c, ca) : bc == none ? in_three(b, c, ca, a, ab) : in_three(c, a, ab, b, bc);
    if (halved < 3) return;
    add(a, ab, ca);
    add(ab, b, bc);
    add(ca, bc, c);
    add(ab, bc, ca);
  }

  void in_two(std::uint32_t a, std::uint32_t ab, std::uint32_t b, std::uint32_t c) {
    add(a, ab, c);
    add(ab, b, c);
  }

  /// What is left of the corner c is cut along its shorter diagonal.
  void in_three(std::uint32_t a, std::uint32_t b, std::uint32_t bc, std::uint32_t c, std::uint32_t ca) {
    add(bc, c, ca);
    if (length2(a, bc) < length2(b, ca)) {
      add(a, b, bc);
      add(a, bc, ca);
    } else {
      add(a, b, ca);
      add(b, bc, ca);
    }
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { cut_.insert(cut_.end(), {a, b, c}); }

  Surface surface_;
  const double longest2_;
  Indices cut_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // of this round's edges, the lesser end first
};

}  // namespace

Surface refine(const Surface& surface, const Refinement& refinement) {
  if (surface.indices.size() / 3 >= refinement.most_triangles) return surface;
  for (double edge = refinement.longest_edge;; edge *= longer)
    if (auto refined = Refiner(surface, edge).run(refinement.most_triangles)) return std::move(*refined);
}

}  // namespace onestroke
