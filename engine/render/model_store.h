#pragma once

#include "render/frame_ring.h"
#include "render/frame_scene.h"
#include "render/model_maker.h"

#include <memory>
#include <vector>

namespace onestroke {

/// The models that can be drawn, by their handles. One thread, the one that renders.
class ModelStore {
 public:
  /// Takes a model in; it can be drawn from the next frame on.
  ModelHandle adopt(std::shared_ptr<PreparedModel> prepared);
  void unload(ModelHandle handle, Graveyard& graveyard);
  /// Null where there is no such model.
  const GpuModel* find(ModelHandle handle) const;

  /// Writes the commands that adopted models still need, before any that draw them.
  void record_uploads(FrameSlot& slot);

 private:
  std::vector<std::shared_ptr<GpuModel>> models_;
  std::vector<std::shared_ptr<PreparedModel>> adopted_;  // Since the frame before.
};

}  // namespace onestroke
