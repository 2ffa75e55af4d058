#include "render/model_store.h"

#include <algorithm>

namespace onestroke {

ModelHandle ModelStore::adopt(std::shared_ptr<PreparedModel> prepared) {
  const auto vacant = std::find(models_.begin(), models_.end(), nullptr);
  const auto index = static_cast<std::uint32_t>(vacant - models_.begin());
  if (vacant == models_.end())
    models_.push_back(prepared->model);
  else
    *vacant = prepared->model;
  adopted_.push_back(std::move(prepared));
  return ModelHandle{index};
}

void ModelStore::unload(ModelHandle handle, Graveyard& graveyard) {
  const auto index = static_cast<std::size_t>(handle);
  if (index < models_.size() && models_[index]) graveyard.bury(std::shared_ptr<void>(std::move(models_[index])));
}

const GpuModel* ModelStore::find(ModelHandle handle) const {
  const auto index = static_cast<std::size_t>(handle);
  return index < models_.size() ? models_[index].get() : nullptr;
}

void ModelStore::record_uploads(FrameSlot& slot) {
  for (auto& prepared : adopted_) {
    prepared->upload.record(slot.commands);
    slot.graveyard.bury(std::shared_ptr<void>(std::move(prepared)));
  }
  adopted_.clear();
}

}  // namespace onestroke
