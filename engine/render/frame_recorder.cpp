#include "render/frame_recorder.h"

#include "render/font.h"
#include "render/projection.h"
#include "render/target.h"
#include "render/upload.h"
#include "scene/frames.h"

#include <glm/geometric.hpp>

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

constexpr Access draw_color{Stage::eColorAttachmentOutput, Reach::eColorAttachmentWrite};
constexpr Access draw_depth{Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
                            Reach::eDepthStencilAttachmentRead | Reach::eDepthStencilAttachmentWrite};

gpu::vec4 rgba(const Color& c) {
  return {c.r, c.g, c.b, c.a};
}

void fill_light(gpu::ViewData& data, const Light& light) {
  data.key_direction = gpu::vec4(glm::normalize(direction_to_graphics(light.to_key_world)), 0.0F);
  data.key_color = rgba(light.key);
  data.sky_color = rgba(light.sky);
  data.ground_color = rgba(light.ground);
}

Image make_glyphs(Device& device) {
  const FontAtlas& atlas = font_atlas();
  return upload_image(device,
                      {.format = vk::Format::eR8Unorm,
                       .width = static_cast<std::uint32_t>(atlas.width),
                       .height = static_cast<std::uint32_t>(atlas.height)},
                      atlas.texels);
}

vk::raii::Sampler make_sampler(Device& device) {
  return device.vk().createSampler({.magFilter = vk::Filter::eLinear,
                                    .minFilter = vk::Filter::eLinear,
                                    .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                    .addressModeV = vk::SamplerAddressMode::eClampToEdge});
}

void open_target(const vk::raii::CommandBuffer& commands, const RenderTarget& target, const Image& color,
                 const Image& depth) {
  image_barrier(commands, target.image, {Layout::eUndefined, Layout::eColorAttachmentOptimal},
                {Stage::eColorAttachmentOutput, {}}, draw_color);
  // The frame before may still be writing these.
  image_barrier(commands, color.handle(), {Layout::eUndefined, Layout::eColorAttachmentOptimal}, draw_color,
                {Stage::eColorAttachmentOutput, Reach::eColorAttachmentRead | Reach::eColorAttachmentWrite});
  image_barrier(commands, depth.handle(), {Layout::eUndefined, Layout::eDepthAttachmentOptimal}, draw_depth, draw_depth,
                vk::ImageAspectFlagBits::eDepth);
}

void close_target(const vk::raii::CommandBuffer& commands, const RenderTarget& target) {
  const auto layout = static_cast<Layout>(target.final_layout);
  const bool copied = layout == Layout::eTransferSrcOptimal;
  image_barrier(commands, target.image, {Layout::eColorAttachmentOptimal, layout}, draw_color,
                copied ? Access{Stage::eAllTransfer, Reach::eTransferRead} : Access{Stage::eAllCommands, {}});
}

void begin_rendering(const vk::raii::CommandBuffer& commands, const RenderTarget& target, const Image& color,
                     const Image& depth, const Color& background) {
  const vk::RenderingAttachmentInfo color_attachment{
      .imageView = color.view(),
      .imageLayout = Layout::eColorAttachmentOptimal,
      .resolveMode = vk::ResolveModeFlagBits::eAverage,
      .resolveImageView = target.view,
      .resolveImageLayout = Layout::eColorAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eDontCare,
      .clearValue = {.color = {.float32 = std::array{background.r, background.g, background.b, background.a}}}};
  const vk::RenderingAttachmentInfo depth_attachment{.imageView = depth.view(),
                                                     .imageLayout = Layout::eDepthAttachmentOptimal,
                                                     .loadOp = vk::AttachmentLoadOp::eClear,
                                                     .storeOp = vk::AttachmentStoreOp::eDontCare,
                                                     .clearValue = {.depthStencil = {.depth = 0}}};
  commands.beginRendering(
      {.renderArea = {.extent = {static_cast<std::uint32_t>(target.width), static_cast<std::uint32_t>(target.height)}},
       .layerCount = 1,
       .colorAttachmentCount = 1,
       .pColorAttachments = &color_attachment,
       .pDepthAttachment = &depth_attachment});
}

void set_viewport(const vk::raii::CommandBuffer& commands, const Viewport& v) {
  const auto width = static_cast<std::uint32_t>(v.width), height = static_cast<std::uint32_t>(v.height);
  commands.setViewport(0, vk::Viewport{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.width),
                                       static_cast<float>(v.height), 0.0F, 1.0F});
  commands.setScissor(0, vk::Rect2D{{v.x, v.y}, {width, height}});
}

}  // namespace

FrameRecorder::FrameRecorder(Device& device, const Layouts& layouts, const ModelStore& models)
    : device_(device),
      layouts_(layouts),
      models_(models),
      sampler_(make_sampler(device)),
      glyphs_(make_glyphs(device)) {}

void FrameRecorder::fit(const RenderTarget& target, Graveyard& graveyard) {
  const auto format = static_cast<vk::Format>(target.format);
  const auto width = static_cast<std::uint32_t>(target.width), height = static_cast<std::uint32_t>(target.height);
  if (!pipelines_ || pipelines_->color != format) {
    // Displays keep their format, so this waits only when a second display takes turns with the first.
    if (pipelines_) device_.vk().waitIdle();
    pipelines_.emplace(device_, layouts_, format);
  }
  if (color_ && color_.info().format == format && color_.info().width == width && color_.info().height == height)
    return;
  graveyard.bury(std::move(color_));
  graveyard.bury(std::move(depth_));
  const auto passing = vk::ImageUsageFlagBits::eTransientAttachment;
  color_ = Image(device_, {.format = format,
                           .width = width,
                           .height = height,
                           .samples = sample_count,
                           .usage = vk::ImageUsageFlagBits::eColorAttachment | passing});
  depth_ = Image(device_, {.format = depth_format,
                           .width = width,
                           .height = height,
                           .samples = sample_count,
                           .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | passing});
}

void FrameRecorder::fill_arena(FrameSlot& slot, const FrameScene& scene, std::span<const View> views,
                               const PictureStore& picture) {
  const std::uint64_t alignment =
      std::max<std::uint64_t>(device_.properties().limits.minUniformBufferOffsetAlignment, 16);
  view_step_ = (sizeof(gpu::ViewData) + alignment - 1) / alignment * alignment;
  slot.arena.begin(device_,
                   view_step_ * max_views + overlay_.quads().size_bytes() + overlay_.lines().size_bytes() + 64);
  bool first = true;
  for (const auto& view : views) {
    gpu::ViewData data{};
    fill_view(data, view);
    fill_light(data, scene.light);
    if (picture.shown() && scene.passthrough_distance)
      fill_picture(data, view, picture.intrinsics(), picture.width(), picture.height(), picture.T_world_camera(),
                   *scene.passthrough_distance);
    const auto at = slot.arena.put(std::span<const gpu::ViewData>(&data, 1), alignment);
    if (first) views_at_ = at;
    first = false;
  }
  quads_at_ = slot.arena.put(overlay_.quads());
  lines_at_ = slot.arena.put(overlay_.lines());
}

void FrameRecorder::write_set(const FrameSlot& slot, const PictureStore& picture) {
  const vk::DescriptorBufferInfo view{.buffer = slot.arena.handle(), .range = sizeof(gpu::ViewData)};
  const std::array images{
      vk::DescriptorImageInfo{
          .sampler = *sampler_, .imageView = picture.view(), .imageLayout = Layout::eShaderReadOnlyOptimal},
      vk::DescriptorImageInfo{
          .sampler = *sampler_, .imageView = glyphs_.view(), .imageLayout = Layout::eShaderReadOnlyOptimal}};
  // The two images have neighbouring bindings, so one write fills both.
  static_assert(BINDING_GLYPHS == BINDING_PICTURE + 1);
  const std::array writes{vk::WriteDescriptorSet{.dstSet = slot.set,
                                                 .dstBinding = BINDING_VIEW,
                                                 .descriptorCount = 1,
                                                 .descriptorType = vk::DescriptorType::eUniformBufferDynamic,
                                                 .pBufferInfo = &view},
                          vk::WriteDescriptorSet{.dstSet = slot.set,
                                                 .dstBinding = BINDING_PICTURE,
                                                 .descriptorCount = images.size(),
                                                 .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                                                 .pImageInfo = images.data()}};
  device_.vk().updateDescriptorSets(writes, {});
}

void FrameRecorder::record(FrameSlot& slot, const FrameScene& scene, std::span<const View> views,
                           const RenderTarget& target, PictureStore& picture) {
  fit(target, slot.graveyard);
  models_.prepare(scene.instances, views);
  overlay_.build(scene, views);
  picture.record(slot);
  fill_arena(slot, scene, views, picture);
  write_set(slot, picture);
  open_target(slot.commands, target, color_, depth_);
  begin_rendering(slot.commands, target, color_, depth_, scene.background);
  record_views(slot, views, picture.shown() && scene.passthrough_distance);
  slot.commands.endRendering();
  close_target(slot.commands, target);
}

void FrameRecorder::record_views(const FrameSlot& slot, std::span<const View> views, bool passthrough) {
  const auto& commands = slot.commands;
  std::uint64_t at = views_at_;
  for (const auto& view : views) {
    set_viewport(commands, view.viewport);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_.pipeline, 0, slot.set,
                                static_cast<std::uint32_t>(at));
    if (passthrough) {
      commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_->passthrough);
      commands.draw(3, 1, 0, 0);
    }
    models_.record(commands, layouts_, *pipelines_, point_to_graphics(view.T_world_view.translation));
    record_overlay(slot);
    at += view_step_;
  }
}

void FrameRecorder::record_overlay(const FrameSlot& slot) {
  const auto& commands = slot.commands;
  const auto bind = vk::PipelineBindPoint::eGraphics;
  if (const auto count = static_cast<std::uint32_t>(overlay_.lines().size())) {
    commands.bindPipeline(bind, *pipelines_->line);
    commands.bindVertexBuffers(0, slot.arena.handle(), vk::DeviceSize{lines_at_});
    commands.draw(4, count, 0, 0);
  }
  const auto count = static_cast<std::uint32_t>(overlay_.quads().size()), tested = overlay_.tested();
  if (count == 0) return;
  commands.bindVertexBuffers(0, slot.arena.handle(), vk::DeviceSize{quads_at_});
  if (tested > 0) {
    commands.bindPipeline(bind, *pipelines_->quad);
    commands.draw(4, tested, 0, 0);
  }
  if (count > tested) {
    commands.bindPipeline(bind, *pipelines_->quad_on_top);
    commands.draw(4, count - tested, 0, tested);
  }
}

}  // namespace onestroke
