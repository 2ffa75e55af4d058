#pragma once

#include "marker/catalog.h"
#include "render/renderer.h"
#include "scene/comparison.h"

#include <glm/mat4x4.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace onestroke {

/// What the renderer draws for one marker.
struct ShelfEntry {
  int marker_id = 0;
  std::optional<ModelHandle> model;  ///< None where the marker carries none.
  glm::mat4 marker_graphics_from_model{1};
  /// No part of the model is farther from anchor_pivot, mm.
  double reach = 0;
  std::vector<Vec3> corners;  ///< Of the rod's straight axes, tip to tip; marker frame, mm.
  std::vector<Vec3> cells;    ///< Middles of the rings, in order; marker frame, mm.
  double radius = 0;          ///< Of the rod, mm.
  ModelHandle rod{};          ///< In the marker's frame, graphics axes; an occluder.
};

/// The models of a catalogue, taken to the GPU at start-up.
class ModelShelf {
 public:
  /// Model paths that are not absolute start at `folder`, the catalogue's. Throws Error that names the marker and the
  /// file.
  ModelShelf(const Catalog& catalog, const std::filesystem::path& folder, Renderer& renderer);

  /// nullptr for a marker that the catalogue lacks.
  const ShelfEntry* find(int marker_id) const;
  /// For the labels. A model that is called as its marker is goes without a name of its own.
  const std::vector<CarriedModel>& carried() const { return carried_; }

 private:
  std::vector<ShelfEntry> entries_;
  std::vector<CarriedModel> carried_;
};

}  // namespace onestroke
