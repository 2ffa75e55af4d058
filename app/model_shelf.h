#pragma once

#include "app/model_loader.h"
#include "marker/catalog.h"
#include "render/renderer.h"
#include "scene/anchor.h"
#include "scene/comparison.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace onestroke {

/// What the renderer draws for one marker.
struct ShelfEntry {
  int marker_id = 0;
  std::optional<ModelHandle> model;  ///< None where the marker carries none, or none yet.
  Placement placement{};
  bool closed = false;        ///< The model has an inside everywhere.
  std::string card;           ///< What is known of the model, some lines.
  std::vector<Vec3> corners;  ///< Of the rod's straight axes, tip to tip; marker frame, mm.
  std::vector<Vec3> cells;    ///< Middles of the rings, in order; marker frame, mm.
  double radius = 0;          ///< Of the rod, mm.
  ModelHandle rod{};          ///< In the marker's frame, graphics axes; an occluder.
};

/// The models of a catalogue. They are loaded on a thread of their own; the rest is for the thread that renders.
class ModelShelf {
 public:
  /// Model paths that are not absolute start at `folder`, the catalogue's. The renderer outlives this.
  ModelShelf(const Catalog& catalog, const std::filesystem::path& folder, Renderer& renderer);

  /// Once a frame: takes in what has been loaded, and says how far the rest is. Never waits; allocates nothing while
  /// nothing arrives.
  void update();
  /// Waits for all of them, saying now and then how far they are. Throws Error that names the marker and the file where
  /// one cannot be loaded.
  void wait(const std::function<void(const std::string&)>& say = {});

  /// nullptr for a marker that the catalogue lacks.
  const ShelfEntry* find(int marker_id) const;
  /// For the labels; stays where it is. A model that is called as its marker is goes without a name of its own. One
  /// that is not there yet is said to be loading, and one that cannot be loaded has the reason.
  std::span<const CarriedModel> carried() const { return carried_; }

 private:
  struct Wished {
    bool settled = false;
    std::vector<std::size_t> entries;  // which carry it
  };

  void settle(std::size_t wish);
  void take_in(std::size_t wish);
  void give_up(std::size_t wish);
  int percent() const;

  Renderer& renderer_;
  std::vector<ShelfEntry> entries_;
  std::vector<CarriedModel> carried_;  // one an entry
  std::vector<std::string> names_;     // of the markers
  std::vector<Wished> wished_;
  std::vector<std::filesystem::path> files_;  // one a wish
  std::size_t waiting_ = 0;
  std::string failure_;  // the first one's
  std::optional<ModelLoader> loader_;
};

}  // namespace onestroke
