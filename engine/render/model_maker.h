#pragma once

#include "render/pipelines.h"
#include "render/screen_bounds.h"
#include "render/upload.h"
#include "scene/contact_balls.h"
#include "scene/model.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace onestroke {

/// A model on the GPU.
struct GpuModel {
  struct Part {
    std::uint32_t first_index = 0, index_count = 0;
    std::uint32_t material = 0;
    glm::vec3 centre{};  // in the model
    bool blends = false, double_sided = false;
    bool textured = false;  // or tested by its alpha
  };
  using Parts = std::vector<Part>;

  Buffer vertices, indices, material_data;
  std::vector<Image> images;
  vk::raii::DescriptorPool descriptors{nullptr};
  std::vector<vk::DescriptorSet> materials;
  std::vector<Parts> levels;       ///< The full detail first; ever coarser, the same parts in the same order.
  std::vector<float> errors;       ///< Of each level, in the model's unit; the first is 0.
  Box box;                         ///< Round all of it, in the model.
  std::vector<ContactBall> balls;  ///< See contact_balls(); none where the model casts no shadow.
};

/// A model with the commands that it still needs.
struct PreparedModel {
  explicit PreparedModel(Device& device) : model(std::make_shared<GpuModel>()), upload(device) {}

  std::shared_ptr<GpuModel> model;
  Upload upload;
};

/// Makes and fills what a model needs on the GPU. Any thread, and several at a time.
class ModelMaker {
 public:
  ModelMaker(Device& device, const Layouts& layouts);

  /// Throws Error where the model refers to what it does not have, or there is no room.
  std::shared_ptr<PreparedModel> make(const Model& model) const;

 private:
  void add_materials(PreparedModel& prepared, const Model& model) const;
  vk::DescriptorSet write_material(const GpuModel& gpu, const ModelMaterial& material, vk::DescriptorSet set,
                                   std::uint64_t data_at) const;

  Device& device_;
  const Layouts& layouts_;
  vk::raii::Sampler sampler_;
  Image white_;
};

}  // namespace onestroke
