#pragma once

#include "render/device.h"

#include <span>
#include <vector>

namespace onestroke {

/// The stencil counts how many layers of a closed model lie behind each sample: back faces less front faces, which is
/// one where the line of sight comes out of the solid once more than it goes in, so began within it.
enum class Layers {
  ignored,
  counted,
  needed,  ///< Drawn only where there are some.
};

/// What the stencil holds where there are none: the middle, as the count may go below.
inline constexpr std::uint32_t no_layers = 128;

/// A graphics pipeline for dynamic rendering. Viewport and scissor are set while recording.
struct PipelineRecipe {
  std::span<const std::uint32_t> vertex, fragment;  ///< SPIR-V, entry point "main". No fragment shader may be given.
  vk::PipelineLayout layout;
  std::span<const vk::VertexInputBindingDescription> bindings{};
  std::span<const vk::VertexInputAttributeDescription> attributes{};
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleList;
  vk::Format color = vk::Format::eUndefined;  ///< Of the attachment; none here.
  vk::Format depth = vk::Format::eUndefined;  ///< Of the attachment, with a stencil or without; none here.
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  std::uint32_t view_mask = 0;  ///< A bit for every view that is drawn at once; 0 for one by itself.
  bool tests_depth = false;     ///< The reverse way round: nearer is greater.
  bool writes_depth = false;
  Layers layers = Layers::ignored;
  bool writes_color = true;
  bool blends = false;  ///< Premultiplied, over what is there.
  /// Values of the specialisation constants from 0 on, for both shaders; those not given keep their own.
  std::vector<std::uint32_t> constants{};
  bool sets_culling = false;  ///< Culling and front face are set while recording; otherwise nothing is culled.
};

/// To draw to these pixels of the target and to no others.
void set_viewport(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area);

/// Throws vk::SystemError.
vk::raii::Pipeline make_graphics_pipeline(Device& device, const PipelineRecipe& recipe);

}  // namespace onestroke
