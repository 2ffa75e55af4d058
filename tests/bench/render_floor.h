#pragma once

#include "render/resources.h"
#include "render/target.h"

namespace onestroke::bench {

/// The least that anything that fills a target can cost on this GPU: what the renderer is measured against. Each call
/// records, submits and waits, as a frame of the renderer does when it is timed.
class RenderFloor {
 public:
  /// The device and the target outlive this.
  RenderFloor(Device& device, const RenderTarget& target);

  /// The target in one colour, all its layers.
  void clear();
  /// One triangle over each of its layers, with an sRGB texture of the target's size looked up once a pixel.
  void draw_texture();

 private:
  void run(bool textured);
  void fill(bool textured, vk::ImageView layer);

  Device& device_;
  const RenderTarget& target_;
  Image picture_;
  vk::raii::Sampler sampler_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::DescriptorPool descriptors_;
  vk::DescriptorSet set_;
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline pipeline_;
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffer commands_;
  vk::raii::Fence fence_;
};

}  // namespace onestroke::bench
