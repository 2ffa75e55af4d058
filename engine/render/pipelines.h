#pragma once

#include "render/device.h"

#include <array>

namespace onestroke {

inline constexpr auto sample_count = vk::SampleCountFlagBits::e4;

/// The best that the device has with a stencil beside it; every one has such a format.
vk::Format depth_format(const Device& device);

/// What every pipeline shares: set 0 changes by frame, set 1 by material, push constants by draw.
struct Layouts {
  explicit Layouts(Device& device);

  vk::raii::DescriptorSetLayout frame, material;
  vk::raii::PipelineLayout pipeline;
};

/// The pipelines for one format of target and the views that are drawn at once: a bit each, or 0 for one view by
/// itself. What goes to the foreground has several samples and tests depth the reverse way round (nearer is greater);
/// what goes to the picture has neither. See FrameTargets.
struct Pipelines {
  Pipelines(Device& device, const Layouts& layouts, vk::Format color, std::uint32_t view_mask);

  vk::Format color = vk::Format::eUndefined;
  // To the foreground.
  // The first for materials without textures and alpha tests, the second for all others.
  std::array<vk::raii::Pipeline, 2> model;        ///< Writes depth; culling and front face are set while recording.
  std::array<vk::raii::Pipeline, 2> model_blend;  ///< Premultiplied over what is there; does not write depth.
  std::array<vk::raii::Pipeline, 2> model_depth;  ///< Depth alone.
  vk::raii::Pipeline layers;                      ///< Counts a model's layers; see Layers.
  vk::raii::Pipeline cut;                         ///< Where there are layers; premultiplied, writes depth.
  vk::raii::Pipeline finger;                      ///< As model_blend.
  vk::raii::Pipeline line;
  vk::raii::Pipeline quad;
  // To the picture.
  vk::raii::Pipeline passthrough;       ///< Within the picture, where the lens is ideal.
  vk::raii::Pipeline passthrough_lens;  ///< Within the picture.
  vk::raii::Pipeline passthrough_edge;  ///< Round it.
  vk::raii::Pipeline foreground;        ///< What was drawn there, over what is there.
  vk::raii::Pipeline quad_on_top;

 private:
  template <typename Make>
  explicit Pipelines(const Make& make);
};

}  // namespace onestroke
