#include "render/imgui_pass.h"

#include "render/graphics_pipeline.h"
#include "shaders/spirv.h"

#include <imgui.h>

#include <algorithm>

namespace onestroke {

namespace {

using ShaderStage = vk::ShaderStageFlagBits;

/// As shaders/imgui.vert has it.
struct Push {
  float scale_x, scale_y, shift_x, shift_y;
};

vk::raii::DescriptorSetLayout make_set_layout(Device& device) {
  const vk::DescriptorSetLayoutBinding glyphs{0, vk::DescriptorType::eCombinedImageSampler, 1, ShaderStage::eFragment};
  return device.vk().createDescriptorSetLayout({.bindingCount = 1, .pBindings = &glyphs});
}

vk::raii::DescriptorPool make_descriptors(Device& device) {
  const vk::DescriptorPoolSize size{vk::DescriptorType::eCombinedImageSampler, 1};
  return device.vk().createDescriptorPool({.maxSets = 1, .poolSizeCount = 1, .pPoolSizes = &size});
}

/// Goes with its pool.
vk::DescriptorSet make_set(Device& device, vk::DescriptorPool pool, vk::DescriptorSetLayout layout, const Image& glyphs,
                           vk::Sampler sampler) {
  const vk::DescriptorSet set =
      device.vk()
          .allocateDescriptorSets({.descriptorPool = pool, .descriptorSetCount = 1, .pSetLayouts = &layout})
          .front()
          .release();
  const vk::DescriptorImageInfo image{
      .sampler = sampler, .imageView = glyphs.view(), .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
  device.vk().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set,
                                                          .dstBinding = 0,
                                                          .descriptorCount = 1,
                                                          .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                          .pImageInfo = &image},
                                   {});
  return set;
}

vk::raii::PipelineLayout make_layout(Device& device, vk::DescriptorSetLayout set) {
  const vk::PushConstantRange push{ShaderStage::eVertex, 0, sizeof(Push)};
  return device.vk().createPipelineLayout(
      {.setLayoutCount = 1, .pSetLayouts = &set, .pushConstantRangeCount = 1, .pPushConstantRanges = &push});
}

constexpr std::array vertex_bindings{vk::VertexInputBindingDescription{0, sizeof(ImDrawVert)}};
constexpr std::array vertex_attributes{
    vk::VertexInputAttributeDescription{0, 0, vk::Format::eR32G32Sfloat, offsetof(ImDrawVert, pos)},
    vk::VertexInputAttributeDescription{1, 0, vk::Format::eR32G32Sfloat, offsetof(ImDrawVert, uv)},
    vk::VertexInputAttributeDescription{2, 0, vk::Format::eR8G8B8A8Unorm, offsetof(ImDrawVert, col)}};

template <typename T>
std::span<const T> all_of(const ImVector<T>& list) {
  return {list.Data, static_cast<std::size_t>(list.Size)};
}

std::span<ImDrawList* const> lists_of(const ImDrawData& gui) {
  return {gui.CmdLists, static_cast<std::size_t>(gui.CmdListsCount)};
}

/// The part of the viewport that a command may draw to, in the target's pixels; empty where there is none.
vk::Rect2D scissor_of(const ImVec4& clip, const Viewport& v) {
  const auto inside = [](float at, int size) { return std::clamp(static_cast<int>(at), 0, size); };
  const int left = inside(clip.x, v.width), right = inside(clip.z, v.width);
  const int top = inside(clip.y, v.height), bottom = inside(clip.w, v.height);
  return {
      {v.x + left, v.y + top},
      {static_cast<std::uint32_t>(std::max(right - left, 0)), static_cast<std::uint32_t>(std::max(bottom - top, 0))}};
}

}  // namespace

ImguiPass::ImguiPass(Device& device, const Image& glyphs, vk::Sampler sampler)
    : device_(device),
      set_layout_(make_set_layout(device)),
      descriptors_(make_descriptors(device)),
      set_(make_set(device, *descriptors_, *set_layout_, glyphs, sampler)),
      layout_(make_layout(device, *set_layout_)) {}

void ImguiPass::fit(vk::Format target) {
  pipeline_ = make_graphics_pipeline(device_, {.vertex = spirv::imgui_vert(),
                                               .fragment = spirv::imgui_frag(),
                                               .layout = *layout_,
                                               .bindings = vertex_bindings,
                                               .attributes = vertex_attributes,
                                               .color = target,
                                               .blends = true});
}

std::uint64_t ImguiPass::bytes_of(const ImDrawData* gui) {
  if (!gui) return 0;
  constexpr std::uint64_t alignments = 32;
  std::uint64_t bytes = 0;
  for (const ImDrawList* list : lists_of(*gui))
    bytes += all_of(list->VtxBuffer).size_bytes() + all_of(list->IdxBuffer).size_bytes() + alignments;
  return bytes;
}

void ImguiPass::put(Arena& arena, const ImDrawData* gui) {
  places_.clear();
  if (!gui) return;
  for (const ImDrawList* list : lists_of(*gui)) {
    const std::uint64_t vertices = arena.put(all_of(list->VtxBuffer));
    places_.push_back({.vertices = vertices, .indices = arena.put(all_of(list->IdxBuffer))});
  }
}

void ImguiPass::record(const vk::raii::CommandBuffer& commands, vk::Buffer arena, const Viewport& viewport,
                       const ImDrawData* gui) const {
  if (!gui || places_.empty()) return;
  const float x = 2 / static_cast<float>(viewport.width), y = 2 / static_cast<float>(viewport.height);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, **pipeline_);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, set_, {});
  commands.pushConstants<Push>(*layout_, ShaderStage::eVertex, 0, Push{x, y, -1, -1});
  static_assert(sizeof(ImDrawIdx) == 2);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    commands.bindVertexBuffers(0, arena, vk::DeviceSize{places_[i].vertices});
    commands.bindIndexBuffer(arena, places_[i].indices, vk::IndexType::eUint16);
    for (const ImDrawCmd& command : all_of(gui->CmdLists[i]->CmdBuffer)) {
      const vk::Rect2D scissor = scissor_of(command.ClipRect, viewport);
      if (scissor.extent.width == 0 || scissor.extent.height == 0) continue;
      commands.setScissor(0, scissor);
      commands.drawIndexed(command.ElemCount, 1, command.IdxOffset, static_cast<std::int32_t>(command.VtxOffset), 0);
    }
  }
}

}  // namespace onestroke
