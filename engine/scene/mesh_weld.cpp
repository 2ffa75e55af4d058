#include "scene/mesh_weld.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace onestroke {

// What is compared is bytes, so nothing may lie between the numbers, and zero must have one sign.
static_assert(sizeof(ModelVertex) == 16 * sizeof(float));

Places find_places(const Surface& surface) {
  std::vector<std::array<float, 3>> positions(surface.vertices.size());
  std::transform(surface.vertices.begin(), surface.vertices.end(), positions.begin(), [](const ModelVertex& v) {
    return std::array{v.position[0] + 0.0F, v.position[1] + 0.0F, v.position[2] + 0.0F};
  });
  Places places;
  places.of_vertex.resize(positions.size());
  if (!positions.empty())
    places.count = meshopt_generateVertexRemap(places.of_vertex.data(), nullptr, positions.size(), positions.data(),
                                               positions.size(), sizeof positions[0]);
  return places;
}

void weld(Surface& surface) {
  if (surface.indices.empty()) {
    surface.vertices.clear();
    return;
  }
  for (ModelVertex& v : surface.vertices)
    for (float& x : v.position) x += 0.0F;
  std::vector<std::uint32_t> remap(surface.vertices.size());
  const std::size_t count =
      meshopt_generateVertexRemap(remap.data(), surface.indices.data(), surface.indices.size(), surface.vertices.data(),
                                  surface.vertices.size(), sizeof(ModelVertex));
  std::vector<ModelVertex> vertices(count);
  meshopt_remapVertexBuffer(vertices.data(), surface.vertices.data(), surface.vertices.size(), sizeof(ModelVertex),
                            remap.data());
  meshopt_remapIndexBuffer(surface.indices.data(), surface.indices.data(), surface.indices.size(), remap.data());
  surface.vertices = std::move(vertices);
}

}  // namespace onestroke
