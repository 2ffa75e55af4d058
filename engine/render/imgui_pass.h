#pragma once

#include "render/frame_ring.h"
#include "render/view.h"

#include <optional>
#include <vector>

struct ImDrawData;

namespace onestroke {

/// Draws what Gui laid out. Text is looked up in the glyph atlas.
class ImguiPass {
 public:
  /// The device, the glyphs and the sampler outlive this.
  ImguiPass(Device& device, const Image& glyphs, vk::Sampler sampler);

  /// Makes the pipeline for a format of target; the GPU must be done with one made before.
  void fit(vk::Format target);
  /// How many bytes of a frame's arena put() takes, at most. `gui` may be null.
  static std::uint64_t bytes_of(const ImDrawData* gui);
  void put(Arena& arena, const ImDrawData* gui);
  /// Into a view that is being rendered, over what is there, what put() was given. Does nothing for null.
  void record(const vk::raii::CommandBuffer& commands, vk::Buffer arena, const Viewport& viewport,
              const ImDrawData* gui) const;

 private:
  // Of one of Dear ImGui's lists, in the arena.
  struct Place {
    std::uint64_t vertices = 0, indices = 0;
  };

  Device& device_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::DescriptorPool descriptors_;
  vk::DescriptorSet set_;
  vk::raii::PipelineLayout layout_;
  std::optional<vk::raii::Pipeline> pipeline_;
  std::vector<Place> places_;
};

}  // namespace onestroke
