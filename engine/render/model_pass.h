#pragma once

#include "render/contact_shadows.h"
#include "render/model_store.h"
#include "render/view.h"
#include "shaders/shared.h"

namespace onestroke {

/// Draws the instances of a frame: occluders, then what is opaque, then what lets light through, farthest first.
/// Faces of cuts come before what is opaque, whose hidden insides they spare.
class ModelPass {
 public:
  explicit ModelPass(const ModelStore& store) : store_(store) {}

  /// Sorts the instances by how they are drawn, each in as much detail as the view that shows it largest tells apart.
  /// They must live until the frame is recorded.
  void prepare(std::span<const ModelInstance> instances, std::span<const View> views);
  /// Those of the models that stand near another, to be given to the shaders.
  std::span<const gpu::vec4> balls() const { return shadows_.balls(); }
  /// Where what is seen of them lies; occluders are not seen.
  void add_to(ScreenBounds& bounds) const;
  /// Records a pass that draws to `area`, seen from `eye` (world, graphics axes).
  void record(const vk::raii::CommandBuffer& commands, const Layouts& layouts, const Pipelines& pipelines,
              vk::Rect2D area, const glm::vec3& eye);

 private:
  struct Draw {
    const GpuModel* model = nullptr;
    const GpuModel::Parts* level = nullptr;
    const GpuModel::Part* part = nullptr;  // of the level; null: every one of it
    const ModelInstance* instance = nullptr;
    BallRange shadow{};
    bool filled = false;
    float distance = 0;
  };

  struct Recorder;
  void record_blended(Recorder& recorder, const Pipelines& pipelines);

  const ModelStore& store_;
  ContactShadows shadows_;
  std::vector<Draw> occluders_, cuts_, opaque_, blended_;
};

}  // namespace onestroke
