#pragma once

#include "render/device.h"

#include <span>

namespace onestroke {

/// A graphics pipeline for dynamic rendering. Viewport and scissor are set while recording; nothing is culled.
struct PipelineRecipe {
  std::span<const std::uint32_t> vertex, fragment;  ///< SPIR-V, entry point "main".
  vk::PipelineLayout layout;
  std::span<const vk::VertexInputBindingDescription> bindings{};
  std::span<const vk::VertexInputAttributeDescription> attributes{};
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  vk::Format color = vk::Format::eUndefined;
  vk::Format depth = vk::Format::eUndefined;  ///< Of the attachment, which is neither tested nor written; none here.
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  bool blends = false;  ///< Premultiplied, over what is there.
};

/// Throws vk::SystemError.
vk::raii::Pipeline make_graphics_pipeline(Device& device, const PipelineRecipe& recipe);

}  // namespace onestroke
