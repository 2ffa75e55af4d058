#include "render/pipelines.h"

#include "scene/model.h"
#include "shaders/shared.h"
#include "shaders/spirv.h"

namespace onestroke {

namespace {

using ShaderStage = vk::ShaderStageFlagBits;
using Words = std::span<const std::uint32_t>;

struct Recipe {
  Words vertex, fragment;
  std::span<const vk::VertexInputBindingDescription> bindings;
  std::span<const vk::VertexInputAttributeDescription> attributes;
  vk::PrimitiveTopology topology = vk::PrimitiveTopology::eTriangleStrip;
  bool tests_depth = false, writes_depth = false, writes_color = true, blends = false, sets_culling = false;
};

constexpr auto floats = [](std::uint32_t n) {
  constexpr std::array formats{vk::Format::eR32Sfloat, vk::Format::eR32G32Sfloat, vk::Format::eR32G32B32Sfloat,
                               vk::Format::eR32G32B32A32Sfloat};
  return formats.at(n - 1);
};

const std::array model_bindings{vk::VertexInputBindingDescription{0, sizeof(ModelVertex)}};
const std::array model_attributes{vk::VertexInputAttributeDescription{0, 0, floats(3), offsetof(ModelVertex, position)},
                                  vk::VertexInputAttributeDescription{1, 0, floats(3), offsetof(ModelVertex, normal)},
                                  vk::VertexInputAttributeDescription{2, 0, floats(4), offsetof(ModelVertex, tangent)},
                                  vk::VertexInputAttributeDescription{3, 0, floats(2), offsetof(ModelVertex, uv)},
                                  vk::VertexInputAttributeDescription{4, 0, floats(4), offsetof(ModelVertex, color)}};

const std::array quad_bindings{
    vk::VertexInputBindingDescription{0, sizeof(gpu::QuadData), vk::VertexInputRate::eInstance}};
const std::array line_bindings{
    vk::VertexInputBindingDescription{0, sizeof(gpu::LineData), vk::VertexInputRate::eInstance}};

template <std::uint32_t count>
std::array<vk::VertexInputAttributeDescription, count> vec4_attributes() {
  std::array<vk::VertexInputAttributeDescription, count> list;
  for (std::uint32_t i = 0; i < count; ++i) list[i] = {i, 0, floats(4), i * 16};
  return list;
}
const auto quad_attributes = vec4_attributes<6>();
const auto line_attributes = vec4_attributes<3>();

vk::raii::ShaderModule make_module(Device& device, Words words) {
  return device.vk().createShaderModule({.codeSize = words.size_bytes(), .pCode = words.data()});
}

vk::PipelineColorBlendAttachmentState blend_of(const Recipe& recipe) {
  using Factor = vk::BlendFactor;
  vk::PipelineColorBlendAttachmentState state{.blendEnable = recipe.blends,
                                              .srcColorBlendFactor = Factor::eOne,
                                              .dstColorBlendFactor = Factor::eOneMinusSrcAlpha,
                                              .srcAlphaBlendFactor = Factor::eOne,
                                              .dstAlphaBlendFactor = Factor::eOneMinusSrcAlpha};
  if (recipe.writes_color) state.colorWriteMask = vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags;
  return state;
}

struct Place {
  Device& device;
  const Layouts& layouts;
  vk::Format color;
  std::uint32_t view_mask;
};

vk::raii::Pipeline make_pipeline(const Place& place, const Recipe& recipe) {
  Device& device = place.device;
  const auto vertex = make_module(device, recipe.vertex), fragment = make_module(device, recipe.fragment);
  const std::array stages{
      vk::PipelineShaderStageCreateInfo{.stage = ShaderStage::eVertex, .module = *vertex, .pName = "main"},
      vk::PipelineShaderStageCreateInfo{.stage = ShaderStage::eFragment, .module = *fragment, .pName = "main"}};
  const vk::PipelineVertexInputStateCreateInfo input{
      .vertexBindingDescriptionCount = static_cast<std::uint32_t>(recipe.bindings.size()),
      .pVertexBindingDescriptions = recipe.bindings.data(),
      .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(recipe.attributes.size()),
      .pVertexAttributeDescriptions = recipe.attributes.data()};
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = recipe.topology};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1};
  const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = sample_count};
  const vk::PipelineDepthStencilStateCreateInfo depth{.depthTestEnable = recipe.tests_depth,
                                                      .depthWriteEnable = recipe.writes_depth,
                                                      .depthCompareOp = vk::CompareOp::eGreaterOrEqual};
  const auto blend = blend_of(recipe);
  const vk::PipelineColorBlendStateCreateInfo blends{.attachmentCount = 1, .pAttachments = &blend};
  const std::array dynamic{vk::DynamicState::eViewport, vk::DynamicState::eScissor, vk::DynamicState::eCullMode,
                           vk::DynamicState::eFrontFace};
  const vk::PipelineDynamicStateCreateInfo dynamics{.dynamicStateCount = recipe.sets_culling ? 4U : 2U,
                                                    .pDynamicStates = dynamic.data()};
  const vk::PipelineRenderingCreateInfo rendering{.viewMask = place.view_mask,
                                                  .colorAttachmentCount = 1,
                                                  .pColorAttachmentFormats = &place.color,
                                                  .depthAttachmentFormat = depth_format};
  return device.vk().createGraphicsPipeline(device.pipeline_cache(), {.pNext = &rendering,
                                                                      .stageCount = stages.size(),
                                                                      .pStages = stages.data(),
                                                                      .pVertexInputState = &input,
                                                                      .pInputAssemblyState = &assembly,
                                                                      .pViewportState = &viewport,
                                                                      .pRasterizationState = &raster,
                                                                      .pMultisampleState = &multisample,
                                                                      .pDepthStencilState = &depth,
                                                                      .pColorBlendState = &blends,
                                                                      .pDynamicState = &dynamics,
                                                                      .layout = *place.layouts.pipeline});
}

Recipe passthrough_recipe() {
  return {.vertex = spirv::passthrough_vert(), .fragment = spirv::passthrough_frag(), .bindings = {}, .attributes = {}};
}

Recipe model_recipe(bool writes_color, bool blends) {
  return {.vertex = spirv::model_vert(),
          .fragment = spirv::model_frag(),
          .bindings = model_bindings,
          .attributes = model_attributes,
          .topology = vk::PrimitiveTopology::eTriangleList,
          .tests_depth = true,
          .writes_depth = !blends,
          .writes_color = writes_color,
          .blends = blends,
          .sets_culling = true};
}

Recipe finger_recipe() {
  return {.vertex = spirv::finger_vert(),
          .fragment = spirv::finger_frag(),
          .bindings = {},
          .attributes = {},
          .tests_depth = true,
          .blends = true};
}

Recipe line_recipe() {
  return {.vertex = spirv::line_vert(),
          .fragment = spirv::line_frag(),
          .bindings = line_bindings,
          .attributes = line_attributes,
          .tests_depth = true,
          .blends = true};
}

Recipe quad_recipe(bool tests_depth) {
  return {.vertex = spirv::quad_vert(),
          .fragment = spirv::quad_frag(),
          .bindings = quad_bindings,
          .attributes = quad_attributes,
          .tests_depth = tests_depth,
          .blends = true};
}

vk::raii::DescriptorSetLayout make_set_layout(Device& device,
                                              std::span<const vk::DescriptorSetLayoutBinding> bindings) {
  return device.vk().createDescriptorSetLayout(
      {.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()});
}

vk::raii::DescriptorSetLayout frame_layout(Device& device) {
  using Type = vk::DescriptorType;
  const auto both = ShaderStage::eVertex | ShaderStage::eFragment;
  const std::array bindings{
      vk::DescriptorSetLayoutBinding{BINDING_VIEWS, Type::eUniformBufferDynamic, 1, both},
      vk::DescriptorSetLayoutBinding{BINDING_SCENE, Type::eUniformBuffer, 1, both},
      vk::DescriptorSetLayoutBinding{BINDING_SURFACE, Type::eStorageBuffer, 1, ShaderStage::eVertex},
      vk::DescriptorSetLayoutBinding{BINDING_PICTURE, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_GLYPHS, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_LENS, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_ROOM, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_FINGERS, Type::eCombinedImageSampler, 1, ShaderStage::eFragment}};
  return make_set_layout(device, bindings);
}

vk::raii::DescriptorSetLayout material_layout(Device& device) {
  std::array<vk::DescriptorSetLayoutBinding, 6> bindings;
  for (std::uint32_t i = 0; i < bindings.size(); ++i)
    bindings[i] = {
        i, i == BINDING_MATERIAL ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eCombinedImageSampler, 1,
        ShaderStage::eFragment};
  return make_set_layout(device, bindings);
}

vk::raii::PipelineLayout pipeline_layout(Device& device, vk::DescriptorSetLayout frame,
                                         vk::DescriptorSetLayout material) {
  const std::array sets{frame, material};
  const vk::PushConstantRange push{ShaderStage::eVertex | ShaderStage::eFragment, 0, sizeof(gpu::DrawData)};
  return device.vk().createPipelineLayout({.setLayoutCount = sets.size(),
                                           .pSetLayouts = sets.data(),
                                           .pushConstantRangeCount = 1,
                                           .pPushConstantRanges = &push});
}

}  // namespace

Layouts::Layouts(Device& device)
    : frame(frame_layout(device)),
      material(material_layout(device)),
      pipeline(pipeline_layout(device, *frame, *material)) {}

Pipelines::Pipelines(Device& device, const Layouts& layouts, vk::Format target, std::uint32_t view_mask)
    : color(target),
      passthrough(make_pipeline({device, layouts, target, view_mask}, passthrough_recipe())),
      model(make_pipeline({device, layouts, target, view_mask}, model_recipe(true, false))),
      model_blend(make_pipeline({device, layouts, target, view_mask}, model_recipe(true, true))),
      model_depth(make_pipeline({device, layouts, target, view_mask}, model_recipe(false, false))),
      finger(make_pipeline({device, layouts, target, view_mask}, finger_recipe())),
      line(make_pipeline({device, layouts, target, view_mask}, line_recipe())),
      quad(make_pipeline({device, layouts, target, view_mask}, quad_recipe(true))),
      quad_on_top(make_pipeline({device, layouts, target, view_mask}, quad_recipe(false))) {}

}  // namespace onestroke
