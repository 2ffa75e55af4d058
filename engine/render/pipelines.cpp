#include "render/pipelines.h"

#include "render/graphics_pipeline.h"
#include "scene/model.h"
#include "shaders/shared.h"
#include "shaders/spirv.h"

namespace onestroke {

namespace {

using ShaderStage = vk::ShaderStageFlagBits;
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

/// Within the picture and under an ideal lens the shader has less to do.
PipelineRecipe passthrough_recipe(bool lens, bool edge) {
  static_assert(CONSTANT_LENS == 0 && CONSTANT_EDGE == 1);
  return {.vertex = spirv::passthrough_vert(),
          .fragment = spirv::passthrough_frag(),
          .layout = {},
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .constants = {lens, edge}};
}

PipelineRecipe foreground_recipe() {
  return {.vertex = spirv::full_screen_vert(), .fragment = spirv::foreground_frag(), .layout = {}, .blends = true};
}

PipelineRecipe model_recipe(bool textured, bool writes_color, bool blends) {
  static_assert(CONSTANT_TEXTURED == 0);
  return {.vertex = spirv::model_vert(),
          .fragment = spirv::model_frag(),
          .layout = {},
          .bindings = model_bindings,
          .attributes = model_attributes,
          .topology = vk::PrimitiveTopology::eTriangleList,
          .tests_depth = true,
          .writes_depth = !blends,
          .writes_color = writes_color,
          .blends = blends,
          .constants = {textured},
          .sets_culling = true};
}

PipelineRecipe layers_recipe() {
  return {.vertex = spirv::model_vert(),
          .fragment = {},
          .layout = {},
          .bindings = model_bindings,
          .attributes = model_attributes,
          .topology = vk::PrimitiveTopology::eTriangleList,
          .layers = Layers::counted,
          .writes_color = false,
          .sets_culling = true};
}

PipelineRecipe cut_recipe() {
  return {.vertex = spirv::cut_vert(),
          .fragment = spirv::cut_frag(),
          .layout = {},
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .tests_depth = true,
          .writes_depth = true,
          .layers = Layers::needed,
          .blends = true};
}

PipelineRecipe finger_recipe() {
  return {.vertex = spirv::finger_vert(),
          .fragment = spirv::finger_frag(),
          .layout = {},
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .tests_depth = true,
          .blends = true};
}

PipelineRecipe line_recipe() {
  return {.vertex = spirv::line_vert(),
          .fragment = spirv::line_frag(),
          .layout = {},
          .bindings = line_bindings,
          .attributes = line_attributes,
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .tests_depth = true,
          .blends = true};
}

PipelineRecipe quad_recipe(bool tests_depth) {
  return {.vertex = spirv::quad_vert(),
          .fragment = spirv::quad_frag(),
          .layout = {},
          .bindings = quad_bindings,
          .attributes = quad_attributes,
          .topology = vk::PrimitiveTopology::eTriangleStrip,
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
      vk::DescriptorSetLayoutBinding{BINDING_PICTURE, Type::eCombinedImageSampler, MOST_PICTURES,
                                     ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_GLYPHS, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_LENS, Type::eCombinedImageSampler, MOST_PICTURES, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_ROOM, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_FINGERS, Type::eCombinedImageSampler, MOST_PICTURES,
                                     ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_FOREGROUND, Type::eCombinedImageSampler, 1, ShaderStage::eFragment},
      vk::DescriptorSetLayoutBinding{BINDING_DEPTH, Type::eSampledImage, 1, ShaderStage::eFragment}};
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

vk::Format depth_format(const Device& device) {
  constexpr auto best = vk::Format::eD32SfloatS8Uint;
  const vk::FormatProperties has = device.physical().getFormatProperties(best);
  const bool drawn = !!(has.optimalTilingFeatures & vk::FormatFeatureFlagBits::eDepthStencilAttachment);
  return drawn ? best : vk::Format::eD24UnormS8Uint;
}

Layouts::Layouts(Device& device)
    : frame(frame_layout(device)),
      material(material_layout(device)),
      pipeline(pipeline_layout(device, *frame, *material)) {}

Pipelines::Pipelines(Device& device, const Layouts& layouts, vk::Format target, std::uint32_t view_mask)
    : Pipelines([&](PipelineRecipe recipe, bool to_foreground) {
        recipe.layout = *layouts.pipeline;
        recipe.color = target;
        recipe.view_mask = view_mask;
        if (to_foreground) {
          recipe.depth = depth_format(device);
          recipe.samples = sample_count;
        }
        return make_graphics_pipeline(device, recipe);
      }) {
  color = target;
}

template <typename Make>
Pipelines::Pipelines(const Make& make)
    : model{make(model_recipe(false, true, false), true), make(model_recipe(true, true, false), true)},
      model_blend{make(model_recipe(false, true, true), true), make(model_recipe(true, true, true), true)},
      model_depth{make(model_recipe(false, false, false), true), make(model_recipe(true, false, false), true)},
      layers(make(layers_recipe(), true)),
      cut(make(cut_recipe(), true)),
      finger(make(finger_recipe(), true)),
      line(make(line_recipe(), true)),
      quad(make(quad_recipe(true), true)),
      passthrough(make(passthrough_recipe(false, false), false)),
      passthrough_lens(make(passthrough_recipe(true, false), false)),
      passthrough_edge(make(passthrough_recipe(true, true), false)),
      foreground(make(foreground_recipe(), false)),
      quad_on_top(make(quad_recipe(false), false)) {}

}  // namespace onestroke
