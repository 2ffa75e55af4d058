#include "scene/difference_map.h"

#include "scene/color_scale.h"
#include "scene/frames.h"
#include "scene/mesh_weld.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace onestroke {
namespace {

// Of the scale's reach: what is nearer is not shown, for two meshes of one round surface never lie in one another.
constexpr double unseen = 0.05;
constexpr float veil_white = 0.9F;

Model model_of(std::string name, Surface surface, const ModelMaterial& material) {
  Model model;
  model.name = std::move(name);
  model.vertices = std::move(surface.vertices);
  model.indices = std::move(surface.indices);
  model.parts.push_back({.first_index = 0, .index_count = static_cast<std::uint32_t>(model.indices.size())});
  model.materials.push_back(material);
  model.lower.fill(std::numeric_limits<float>::max());
  model.upper.fill(std::numeric_limits<float>::lowest());
  for (const ModelVertex& v : model.vertices)
    for (std::size_t k = 0; k < 3; ++k) {
      model.lower[k] = std::min(model.lower[k], v.position[k]);
      model.upper[k] = std::max(model.upper[k], v.position[k]);
    }
  return model;
}

float veil_at(double distance, double reach) {
  const double share = std::clamp((distance / reach - unseen) / (1 - unseen), 0.0, 1.0);
  return veil_opacity * static_cast<float>(share);
}

void drop_unseen(Surface& surface) {
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto corners = std::span(surface.indices).subspan(i, 3);
    if (std::ranges::any_of(corners, [&surface](std::uint32_t v) { return surface.vertices[v].color[3] > 0; }))
      seen.insert(seen.end(), corners.begin(), corners.end());
  }
  surface.indices = std::move(seen);
  weld(surface);
}

}  // namespace

Model difference_map(const ComparedModel& laid, const ModelDifference& difference) {
  const DifferenceStatistics& s = difference.statistics;
  const ColorScale scale(s.reach);
  Surface surface = laid.refined;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const auto [r, g, b] = scale.color(difference.laid[i] / metres_per_millimetre);
    surface.vertices[i].color = {r, g, b, 1};
  }
  return model_of(laid.name, std::move(surface),
                  {.metallic = 0, .roughness = 0.7F, .double_sided = laid.double_sided || !s.laid.closed});
}

Model difference_veil(const ComparedModel& base, const ModelDifference& difference) {
  const DifferenceStatistics& s = difference.statistics;
  // What lies within the laid model is not missing.
  const bool has_inside = s.laid.closed && s.laid.volume > 0;
  Surface surface = base.refined;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const double distance = difference.base[i] / metres_per_millimetre;
    surface.vertices[i].color = {1, 1, 1, veil_at(has_inside ? distance : std::abs(distance), s.reach)};
  }
  drop_unseen(surface);
  Model veil = model_of(base.name, std::move(surface),
                        {.base_color = {veil_white, veil_white, veil_white, 1},
                         .metallic = 0,
                         .roughness = 0.7F,
                         .alpha_mode = ModelMaterial::AlphaMode::blend,
                         .double_sided = base.double_sided || !s.base.closed});
  veil.casts_shadow = false;
  return veil;
}

}  // namespace onestroke
