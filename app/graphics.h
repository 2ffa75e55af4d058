#pragma once

#include "app/difference_desk.h"
#include "app/model_shelf.h"
#include "render/display.h"
#include "render/renderer.h"

#include <filesystem>
#include <optional>
#include <string>

namespace onestroke {

/// The GPU that a command is asked for, by --gpu, with what the environment asks for. What a display needs is not in
/// it.
GpuOptions gpu_options(const std::string& gpu);

/// A show's GPU and all that is on it: the display's images, the renderer, the models and their differences. What is
/// lost with the GPU can be made again. One thread, the display's.
class Graphics {
 public:
  struct Wanted {
    const Catalog& catalog;              ///< Outlives this.
    std::filesystem::path catalog_file;  ///< In its folder the catalogue's model paths start.
    bool models_first = false;  ///< Whether to wait for all models; otherwise they come while frames are drawn.
    GpuOptions gpu;             ///< What the display needs is added.
  };

  /// The display outlives this. Throws Error.
  Graphics(Display& display, Wanted wanted);

  /// All stay where they are when they are made again.
  Renderer& renderer() { return *renderer_; }
  ModelShelf& shelf() { return *shelf_; }
  DifferenceDesk& differences() { return *differences_; }
  Gpu& gpu() { return *gpu_; }
  const Catalog& catalog() const { return wanted_.catalog; }

  /// Lets all of it go and makes it anew, after the GPU was lost; pictures must be set again. Throws Error.
  void rebuild();

 private:
  void build();

  Display& display_;
  Wanted wanted_;
  std::shared_ptr<RoomLight> room_;
  std::optional<Gpu> gpu_;
  std::optional<Renderer> renderer_;
  std::optional<ModelShelf> shelf_;
  std::optional<DifferenceDesk> differences_;
};

}  // namespace onestroke
