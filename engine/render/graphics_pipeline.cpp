#include "render/graphics_pipeline.h"

#include "render/resources.h"

namespace onestroke {

namespace {

vk::PipelineColorBlendAttachmentState blend_of(const PipelineRecipe& recipe) {
  using Factor = vk::BlendFactor;
  vk::PipelineColorBlendAttachmentState state{.blendEnable = recipe.blends,
                                              .srcColorBlendFactor = Factor::eOne,
                                              .dstColorBlendFactor = Factor::eOneMinusSrcAlpha,
                                              .srcAlphaBlendFactor = Factor::eOne,
                                              .dstAlphaBlendFactor = Factor::eOneMinusSrcAlpha};
  if (recipe.writes_color) state.colorWriteMask = vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags;
  return state;
}

vk::StencilOpState stencil_of(Layers layers, vk::StencilOp count) {
  const bool counts = layers == Layers::counted;
  return {.passOp = counts ? count : vk::StencilOp::eKeep,
          .compareOp = counts ? vk::CompareOp::eAlways : vk::CompareOp::eLess,
          .compareMask = 0xFF,
          .writeMask = 0xFF,
          .reference = no_layers};
}

vk::PipelineDepthStencilStateCreateInfo depth_stencil_of(const PipelineRecipe& recipe) {
  return {.depthTestEnable = recipe.tests_depth,
          .depthWriteEnable = recipe.writes_depth,
          .depthCompareOp = vk::CompareOp::eGreaterOrEqual,
          .stencilTestEnable = recipe.layers != Layers::ignored,
          .front = stencil_of(recipe.layers, vk::StencilOp::eDecrementAndWrap),
          .back = stencil_of(recipe.layers, vk::StencilOp::eIncrementAndWrap)};
}

std::vector<vk::SpecializationMapEntry> entries_of(const std::vector<std::uint32_t>& constants) {
  std::vector<vk::SpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < constants.size(); ++i)
    entries.push_back({i, i * std::uint32_t{sizeof(std::uint32_t)}, sizeof(std::uint32_t)});
  return entries;
}

}  // namespace

void set_viewport(const vk::raii::CommandBuffer& commands, const vk::Rect2D& area) {
  commands.setViewport(
      0, vk::Viewport{static_cast<float>(area.offset.x), static_cast<float>(area.offset.y),
                      static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0.0F, 1.0F});
  commands.setScissor(0, area);
}

vk::raii::Pipeline make_graphics_pipeline(Device& device, const PipelineRecipe& recipe) {
  const auto module_of = [&device](std::span<const std::uint32_t> words) {
    return device.vk().createShaderModule({.codeSize = words.size_bytes(), .pCode = words.data()});
  };
  const bool shades = !recipe.fragment.empty();
  const auto vertex = module_of(recipe.vertex);
  const auto fragment = shades ? module_of(recipe.fragment) : vk::raii::ShaderModule(nullptr);
  const std::vector<vk::SpecializationMapEntry> entries = entries_of(recipe.constants);
  const vk::SpecializationInfo constants{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                         .pMapEntries = entries.data(),
                                         .dataSize = recipe.constants.size() * sizeof(std::uint32_t),
                                         .pData = recipe.constants.data()};
  using Stage = vk::ShaderStageFlagBits;
  const std::array stages{
      vk::PipelineShaderStageCreateInfo{
          .stage = Stage::eVertex, .module = *vertex, .pName = "main", .pSpecializationInfo = &constants},
      vk::PipelineShaderStageCreateInfo{
          .stage = Stage::eFragment, .module = *fragment, .pName = "main", .pSpecializationInfo = &constants}};
  const vk::PipelineVertexInputStateCreateInfo input{
      .vertexBindingDescriptionCount = static_cast<std::uint32_t>(recipe.bindings.size()),
      .pVertexBindingDescriptions = recipe.bindings.data(),
      .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(recipe.attributes.size()),
      .pVertexAttributeDescriptions = recipe.attributes.data()};
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = recipe.topology};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1};
  const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = recipe.samples};
  const vk::PipelineDepthStencilStateCreateInfo depth_stencil = depth_stencil_of(recipe);
  const auto blend = blend_of(recipe);
  const std::uint32_t colors = recipe.color == vk::Format::eUndefined ? 0 : 1;
  const vk::PipelineColorBlendStateCreateInfo blends{.attachmentCount = colors, .pAttachments = &blend};
  const std::array dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor, vk::DynamicState::eCullMode,
                           vk::DynamicState::eFrontFace};
  const vk::PipelineDynamicStateCreateInfo dynamics{.dynamicStateCount = recipe.sets_culling ? 4U : 2U,
                                                    .pDynamicStates = dynamic.data()};
  const vk::PipelineRenderingCreateInfo rendering{
      .viewMask = recipe.view_mask,
      .colorAttachmentCount = colors,
      .pColorAttachmentFormats = &recipe.color,
      .depthAttachmentFormat = recipe.depth,
      .stencilAttachmentFormat = has_stencil(recipe.depth) ? recipe.depth : vk::Format::eUndefined};
  return device.vk().createGraphicsPipeline(device.pipeline_cache(), {.pNext = &rendering,
                                                                      .stageCount = shades ? 2U : 1U,
                                                                      .pStages = stages.data(),
                                                                      .pVertexInputState = &input,
                                                                      .pInputAssemblyState = &assembly,
                                                                      .pViewportState = &viewport,
                                                                      .pRasterizationState = &raster,
                                                                      .pMultisampleState = &multisample,
                                                                      .pDepthStencilState = &depth_stencil,
                                                                      .pColorBlendState = &blends,
                                                                      .pDynamicState = &dynamics,
                                                                      .layout = recipe.layout});
}

}  // namespace onestroke
