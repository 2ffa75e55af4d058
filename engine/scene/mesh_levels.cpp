#include "scene/mesh_levels.h"

#include "scene/level_error.h"
#include "scene/mesh_weld.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace onestroke {

namespace {

using Indices = std::vector<std::uint32_t>;

// Fewer triangles than this cost nothing; a level that saves less than a quarter is not worth its memory.
constexpr std::size_t few_triangles = 1000;
constexpr double worthwhile = 0.75;
// Coarser than a twentieth of its size a model is never wanted: it would be ten pixels large.
constexpr float coarsest = 0.05F;
// From black to white, of the model's size.
constexpr float color_relief = 0.01F;
constexpr float overdraw_for_cache = 1.05F;  // Vertices may be shaded so much more often to save overdraw.

struct Detail {
  Indices indices;
  float error = 0;
};

// One part: the vertices of all its levels, and the full level first.
struct PartDetails {
  std::vector<ModelVertex> vertices;
  std::vector<Detail> details;
};

float brightness(const ModelVertex& v) {
  return 0.3F * v.color[0] + 0.6F * v.color[1] + 0.1F * v.color[2];
}

// Where the simplification is told that the vertices are: lifted by their brightness, so that edges between colours
// are edges of the surface too and last as long.
std::vector<std::array<float, 3>> places_for_simplification(const std::vector<ModelVertex>& vertices) {
  const float scale =
      color_relief * meshopt_simplifyScale(vertices.front().position.data(), vertices.size(), sizeof(ModelVertex));
  std::vector<std::array<float, 3>> places;
  for (const ModelVertex& v : vertices) {
    const float lift = brightness(v) - brightness(vertices.front());
    places.push_back(v.position);
    // Nothing is added where all are alike, so that vertices of a seam stay at one place.
    if (lift != 0)
      for (std::size_t k = 0; k < 3; ++k) places.back()[k] += v.normal[k] * lift * scale;
  }
  return places;
}

class PartLevels {
 public:
  PartLevels(Surface full, bool keeps_normals) : keeps_normals_(keeps_normals), full_size_(full.vertices.size()) {
    part_.vertices = std::move(full.vertices);
    part_.details.push_back({std::move(full.indices)});
    double sum = 0;
    for (std::size_t i = 0; i < finest_left().size(); i += 3) sum += outwards(&finest_left()[i]);
    side_ = sum < 0 ? -1 : 1;
  }

  PartDetails make(const std::function<void()>& step) {
    while (finest_left().size() > 3 * few_triangles) {
      Indices coarser = half_of(finest_left());
      if (!worth_it(coarser) && !keeps_normals_) coarser = half_with_new_normals();
      if (!worth_it(coarser)) break;
      add(std::move(coarser));
      step();
    }
    put_in_order();
    return std::move(part_);
  }

 private:
  const Indices& finest_left() const { return part_.details.back().indices; }
  bool worth_it(const Indices& coarser) const {
    return !coarser.empty() &&
           static_cast<double>(coarser.size()) < worthwhile * static_cast<double>(finest_left().size());
  }

  // The simplification takes all vertices at one place for one, whether used or not, so it gets the used ones alone.
  Indices half_of(const Indices& indices) const {
    std::vector<ModelVertex> vertices;
    Indices inner, outer, known(part_.vertices.size(), none);
    for (const std::uint32_t i : indices) {
      if (known[i] == none) {
        known[i] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(part_.vertices[i]);
        outer.push_back(i);
      }
      inner.push_back(known[i]);
    }
    const auto places = places_for_simplification(vertices);
    Indices half(inner.size());
    half.resize(meshopt_simplify(half.data(), inner.data(), inner.size(), places.front().data(), vertices.size(),
                                 sizeof places.front(), inner.size() / 6 * 3, coarsest, 0, nullptr));
    for (std::uint32_t& i : half) i = outer[i];
    return half;
  }

  // Here and there the simplification folds a surface; the piece that lies upside down would be lit from behind. Once
  // turned it does not fit its neighbours, so that this comes last.
  void turn_over_folded(Indices& indices) const {
    for (std::size_t i = 0; i < indices.size(); i += 3)
      if (outwards(&indices[i]) * side_ < 0) std::swap(indices[i + 1], indices[i + 2]);
  }

  // More than 0 where a triangle faces to where its normals do.
  double outwards(const std::uint32_t* corners) const {
    const auto at = [&](std::size_t k) -> const ModelVertex& { return part_.vertices[corners[k]]; };
    const auto point = [&](std::size_t k) { return glm::dvec3(glm::make_vec3(at(k).position.data())); };
    const auto normal = [&](std::size_t k) { return glm::dvec3(glm::make_vec3(at(k).normal.data())); };
    return glm::dot(glm::cross(point(1) - point(0), point(2) - point(0)), normal(0) + normal(1) + normal(2));
  }

  // A rough surface, as of a scan, has hard edges everywhere, which hold each other fast. What is made of it without
  // them gets normals of its own.
  Indices half_with_new_normals() {
    Surface loose{part_.vertices, {}};
    const Places places = find_places(loose);
    Indices first(places.count, none);
    for (const std::uint32_t i : finest_left()) {
      std::uint32_t& one = first[places.of_vertex[i]];
      if (one == none) one = i;
      loose.indices.push_back(one);
    }
    loose.indices = half_of(loose.indices);
    if (!worth_it(loose.indices)) return {};
    turn_over_folded(loose.indices);
    weld(loose);
    compute_normals(loose, usual_crease);
    if (side_ < 0)
      for (ModelVertex& v : loose.vertices)
        for (float& x : v.normal) x = -x;
    fill_tangents(loose);
    const auto base = static_cast<std::uint32_t>(part_.vertices.size());
    part_.vertices.insert(part_.vertices.end(), loose.vertices.begin(), loose.vertices.end());
    for (std::uint32_t& i : loose.indices) i += base;
    return loose.indices;
  }

  void add(Indices coarser) {
    const double error = level_error(std::span(part_.vertices).first(full_size_), part_.vertices, coarser);
    part_.details.push_back({std::move(coarser), std::max(part_.details.back().error, static_cast<float>(error))});
  }

  // Triangles as a GPU likes them, vertices as the full level needs them and then the others.
  void put_in_order() {
    const auto count = part_.vertices.size();
    Indices all;
    for (Detail& d : part_.details) {
      if (&d != &part_.details.front()) turn_over_folded(d.indices);
      meshopt_optimizeVertexCache(d.indices.data(), d.indices.data(), d.indices.size(), count);
      meshopt_optimizeOverdraw(d.indices.data(), d.indices.data(), d.indices.size(),
                               part_.vertices.front().position.data(), count, sizeof(ModelVertex), overdraw_for_cache);
      all.insert(all.end(), d.indices.begin(), d.indices.end());
    }
    Indices remap(count);
    std::vector<ModelVertex> ordered(meshopt_optimizeVertexFetchRemap(remap.data(), all.data(), all.size(), count));
    meshopt_remapVertexBuffer(ordered.data(), part_.vertices.data(), count, sizeof(ModelVertex), remap.data());
    part_.vertices = std::move(ordered);
    for (Detail& d : part_.details)
      meshopt_remapIndexBuffer(d.indices.data(), d.indices.data(), d.indices.size(), remap.data());
  }

  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  const bool keeps_normals_;
  const std::size_t full_size_;
  double side_ = 1;  // -1 where the full triangles face away from their normals.
  PartDetails part_;
};

Surface surface_of(const Model& model, const ModelPart& part) {
  Surface s;
  s.indices.assign(model.indices.begin() + part.first_index,
                   model.indices.begin() + part.first_index + part.index_count);
  const auto [least, most] = std::minmax_element(s.indices.begin(), s.indices.end());
  const std::uint32_t first = *least, last = *most;
  s.vertices.assign(model.vertices.begin() + first, model.vertices.begin() + last + 1);
  for (std::uint32_t& i : s.indices) i -= first;
  // Seams of a texture that is not there would hold the simplification up.
  if (!model.materials[static_cast<std::size_t>(part.material)].textured())
    for (ModelVertex& v : s.vertices) v.uv = {}, v.tangent = {};
  weld(s);
  return s;
}

// The parts at one level; a part that has no such level shows its coarsest.
ModelLevel level_of(const std::vector<PartDetails>& parts, const std::vector<std::vector<ModelPart>>& ranges,
                    std::size_t level) {
  ModelLevel result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t own = std::min(level, ranges[i].size() - 1);
    result.parts.push_back(ranges[i][own]);
    result.error = std::max(result.error, parts[i].details[own].error);
  }
  return result;
}

}  // namespace

void add_levels(Model& model, const LoadProgress& progress) {
  std::vector<PartDetails> parts;
  std::size_t done = 0, levels = 0;
  for (const ModelPart& part : model.parts) {
    // Each level costs about half of the one before.
    double within = 0, next = 0.5;
    const auto say = [&] {
      within += next, next /= 2;
      const double triangles = static_cast<double>(done) + within * part.index_count;
      if (progress) progress(triangles / static_cast<double>(model.indices.size()));
    };
    // New normals would not go with a map of bumps.
    const bool mapped = model.materials[static_cast<std::size_t>(part.material)].normal_texture >= 0;
    parts.push_back(PartLevels(surface_of(model, part), mapped).make(say));
    done += part.index_count;
    levels = std::max(levels, parts.back().details.size());
  }
  std::vector<ModelVertex> vertices;
  Indices indices;
  std::vector<std::vector<ModelPart>> ranges;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), parts[i].vertices.begin(), parts[i].vertices.end());
    ranges.emplace_back();
    for (const Detail& d : parts[i].details) {
      ranges.back().push_back({static_cast<std::uint32_t>(indices.size()), static_cast<std::uint32_t>(d.indices.size()),
                               model.parts[i].material});
      for (const std::uint32_t v : d.indices) indices.push_back(base + v);
    }
  }
  model.vertices = std::move(vertices);
  model.indices = std::move(indices);
  model.parts = level_of(parts, ranges, 0).parts;
  model.levels.clear();
  for (std::size_t level = 1; level < levels; ++level) model.levels.push_back(level_of(parts, ranges, level));
  if (progress) progress(1);
}

}  // namespace onestroke
