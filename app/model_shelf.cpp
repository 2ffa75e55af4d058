#include "app/model_shelf.h"

#include "app/rod_mesh.h"
#include "core/error.h"
#include "scene/anchor.h"
#include "scene/frames.h"
#include "scene/model.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>

namespace onestroke {
namespace {

struct Loaded {
  ModelHandle handle{};
  std::string name;
  glm::mat4 marker_graphics_from_model{1};
  double reach = 0;
};

double reach_of(const Model& model, const glm::mat4& marker_graphics_from_model) {
  const glm::vec3 pivot = point_to_graphics(anchor_pivot);
  float farthest = 0;
  for (const ModelVertex& v : model.vertices) {
    const glm::vec4 at = marker_graphics_from_model * glm::vec4(v.position[0], v.position[1], v.position[2], 1.0F);
    farthest = std::max(farthest, glm::distance(glm::vec3(at), pivot));
  }
  return farthest / metres_per_millimetre;
}

Loaded load(const std::filesystem::path& file, Renderer& renderer) {
  const Model model = load_model(file);
  const glm::mat4 place = marker_graphics_from_model(model);
  return {renderer.load(model), model.name, place, reach_of(model, place)};
}

std::vector<Vec3> ring_middles(const Shape& shape) {
  std::vector<Vec3> middles;
  for (int i = 0; i < shape.cells(); ++i) middles.push_back(shape.at((i + 0.5) * shape.pitch()).position);
  return middles;
}

/// "bracket_v1" is "bracket v1" to a person.
bool same_words(std::string a, std::string b) {
  std::ranges::replace(a, '_', ' ');
  std::ranges::replace(b, '_', ' ');
  return a == b;
}

}  // namespace

ModelShelf::ModelShelf(const Catalog& catalog, const std::filesystem::path& folder, Renderer& renderer) {
  std::map<std::string, Loaded> loaded;
  for (const MarkerSpec& marker : catalog.markers) {
    ShelfEntry entry{.marker_id = marker.id,
                     .model = {},
                     .corners = marker.shape.vertices(),
                     .cells = ring_middles(marker.shape),
                     .radius = marker.shape.radius(),
                     .rod = renderer.load(rod_mesh(marker.shape))};
    CarriedModel carried{marker.id, {}};
    if (!marker.model.empty()) {
      auto at = loaded.find(marker.model);
      try {
        if (at == loaded.end()) at = loaded.emplace(marker.model, load(folder / marker.model, renderer)).first;
      } catch (const Error& error) {
        throw Error("marker " + std::to_string(marker.id) + " (" + marker.name + "): " + error.what());
      }
      const Loaded& model = at->second;
      entry.model = model.handle;
      entry.marker_graphics_from_model = model.marker_graphics_from_model;
      entry.reach = model.reach;
      if (!same_words(model.name, marker.name)) carried.model_name = model.name;
    }
    entries_.push_back(entry);
    carried_.push_back(std::move(carried));
  }
}

const ShelfEntry* ModelShelf::find(int marker_id) const {
  const auto at = std::ranges::find(entries_, marker_id, &ShelfEntry::marker_id);
  return at == entries_.end() ? nullptr : &*at;
}

}  // namespace onestroke
