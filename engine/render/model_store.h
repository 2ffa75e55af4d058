#pragma once

#include "render/frame_scene.h"
#include "render/pipelines.h"
#include "render/resources.h"
#include "scene/contact_balls.h"
#include "scene/model.h"

#include <glm/vec3.hpp>

namespace onestroke {

/// A model on the GPU.
struct GpuModel {
  struct Part {
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;
    glm::vec3 centre{};  // in the model
    bool blends = false, double_sided = false;
  };

  Buffer vertices, indices, material_data;
  std::vector<Image> images;
  vk::raii::DescriptorPool descriptors{nullptr};
  std::vector<vk::DescriptorSet> materials;
  std::vector<Part> parts;
  std::vector<Ball> balls;  // see contact_balls()
};

class ModelStore {
 public:
  ModelStore(Device& device, const Layouts& layouts);

  /// Blocks while the model goes to the GPU. Throws Error where it refers to what it does not have.
  ModelHandle load(const Model& model);
  void unload(ModelHandle handle, Graveyard& graveyard);
  /// Null where there is no such model.
  const GpuModel* find(ModelHandle handle) const;

 private:
  void add_materials(GpuModel& gpu, const Model& model);
  vk::DescriptorSet write_material(const GpuModel& gpu, const ModelMaterial& material, vk::DescriptorSet set,
                                   std::uint64_t data_at) const;

  Device& device_;
  const Layouts& layouts_;
  vk::raii::Sampler sampler_;
  Image white_;
  std::vector<std::shared_ptr<GpuModel>> models_;
};

}  // namespace onestroke
