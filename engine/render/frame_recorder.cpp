#include "render/frame_recorder.h"

#include "render/font.h"
#include "render/multiview_probe.h"
#include "render/upload.h"
#include "scene/frames.h"

#include <algorithm>

namespace onestroke {

namespace {

using Layout = vk::ImageLayout;

constexpr Color surround{SURROUND_R, SURROUND_G, SURROUND_B, 1};

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
                                    .mipmapMode = vk::SamplerMipmapMode::eLinear,
                                    .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                    .addressModeV = vk::SamplerAddressMode::eClampToEdge,
                                    .maxLod = VK_LOD_CLAMP_NONE});
}

void set_viewport(const vk::raii::CommandBuffer& commands, const Viewport& v) {
  const auto width = static_cast<std::uint32_t>(v.width), height = static_cast<std::uint32_t>(v.height);
  commands.setViewport(0, vk::Viewport{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.width),
                                       static_cast<float>(v.height), 0.0F, 1.0F});
  commands.setScissor(0, vk::Rect2D{{v.x, v.y}, {width, height}});
}

/// Where blended surfaces are sorted from: the middle of the views of a pass.
glm::vec3 eye_of(std::span<const View> views) {
  Vec3 sum;
  for (const View& view : views) sum = sum + view.T_world_view.translation;
  return point_to_graphics(sum / static_cast<double>(views.size()));
}

}  // namespace

FrameRecorder::FrameRecorder(Device& device, const Layouts& layouts, const ModelStore& models, bool multiview)
    : device_(device),
      layouts_(layouts),
      multiview_(multiview),
      models_(models),
      targets_(device),
      sampler_(make_sampler(device)),
      glyphs_(make_glyphs(device)),
      gui_(device, glyphs_, *sampler_) {}

bool FrameRecorder::can_draw_together(std::span<const View> views) {
  if (!multiview_ || views.size() < 2) return false;
  if (!multiview_works_) multiview_works_ = multiview_works(device_);
  const auto same = [&views](const View& v) {
    const Viewport &a = v.viewport, &b = views.front().viewport;
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
  };
  return *multiview_works_ && std::all_of(views.begin(), views.end(), same);
}

const Pipelines& FrameRecorder::pipelines_for(const RenderTarget& target, std::uint32_t view_mask) {
  const auto format = static_cast<vk::Format>(target.format);
  auto& pipelines = pipelines_[view_mask ? 1 : 0];
  if (!pipelines || pipelines->color != format) {
    // Displays keep their format, so this waits only when a second display takes turns with the first.
    if (pipelines) device_.vk().waitIdle();
    pipelines.emplace(device_, layouts_, format, view_mask);
    if (view_mask == 0) gui_.fit(format);
  }
  return *pipelines;
}

void FrameRecorder::build_surface(const FrameScene& scene, const PictureStore& picture) {
  data_.passthrough = picture.shown() && scene.passthrough_distance;
  if (data_.passthrough) surface_.build(picture.bounds(), scene.passthrough_segments, *scene.passthrough_distance);
}

void FrameRecorder::write_set(const FrameSlot& slot, const Seen& seen) const {
  using Type = vk::DescriptorType;
  const vk::Buffer arena = slot.arena.handle();
  const std::array buffers{vk::DescriptorBufferInfo{.buffer = arena, .range = PASS_VIEWS * sizeof(gpu::ViewData)},
                           vk::DescriptorBufferInfo{arena, data_.scene_at, sizeof(gpu::SceneData)},
                           vk::DescriptorBufferInfo{arena, data_.surface_at, data_.surface_bytes}};
  const auto sampled = [this](vk::ImageView view) {
    return vk::DescriptorImageInfo{*sampler_, view, Layout::eShaderReadOnlyOptimal};
  };
  const std::array images{sampled(seen.picture.view()), sampled(glyphs_.view()), sampled(seen.picture.lens_view()),
                          sampled(seen.lighting.view()), sampled(seen.fingers.view())};
  // The images have neighbouring bindings, so one write fills them all.
  static_assert(BINDING_GLYPHS == BINDING_PICTURE + 1 && BINDING_LENS == BINDING_PICTURE + 2 &&
                BINDING_ROOM == BINDING_PICTURE + 3 && BINDING_FINGERS == BINDING_PICTURE + 4);
  const auto buffer_write = [&](std::uint32_t binding, Type type, const vk::DescriptorBufferInfo& info) {
    return vk::WriteDescriptorSet{
        .dstSet = slot.set, .dstBinding = binding, .descriptorCount = 1, .descriptorType = type, .pBufferInfo = &info};
  };
  const std::array writes{buffer_write(BINDING_VIEWS, Type::eUniformBufferDynamic, buffers[0]),
                          buffer_write(BINDING_SCENE, Type::eUniformBuffer, buffers[1]),
                          buffer_write(BINDING_SURFACE, Type::eStorageBuffer, buffers[2]),
                          vk::WriteDescriptorSet{.dstSet = slot.set,
                                                 .dstBinding = BINDING_PICTURE,
                                                 .descriptorCount = images.size(),
                                                 .descriptorType = Type::eCombinedImageSampler,
                                                 .pImageInfo = images.data()}};
  device_.vk().updateDescriptorSets(writes, {});
}

void FrameRecorder::record(FrameSlot& slot, const FrameScene& scene, std::span<const View> views,
                           const RenderTarget& target, const Seen& seen) {
  plan_passes(data_, views, can_draw_together(views));
  const std::uint32_t view_mask = data_.passes.front().view_mask;
  const bool by_layer = view_mask == 0 && target.layers > 1;
  targets_.fit(target, by_layer ? FrameTargets::Way::by_layer : FrameTargets::Way::at_once, slot.graveyard);
  models_.prepare(scene.instances, views);
  overlay_.build(scene, views);
  seen.picture.record(slot);
  seen.lighting.record(slot, scene);
  seen.fingers.record(slot);
  build_surface(scene, seen.picture);
  fill_arena(data_, device_, slot.arena,
             {scene, views, seen.picture, seen.lighting.light(), surface_, overlay_, models_.balls(),
              seen.fingers.matte_from_picture(seen.picture.width(), seen.picture.height())});
  gui_.put(slot.arena, scene.gui);
  write_set(slot, seen);
  targets_.open(slot.commands, target);
  for (const FramePass& pass : std::span(data_.passes).first(data_.pass_count))
    record_pass(slot, pass, views, target, scene, seen);
  targets_.close(slot.commands, target);
}

void FrameRecorder::record_pass(const FrameSlot& slot, const FramePass& pass, std::span<const View> views,
                                const RenderTarget& target, const FrameScene& scene, const Seen& seen) {
  const auto& commands = slot.commands;
  const Pipelines& pipelines = pipelines_for(target, pass.view_mask);
  const auto drawn = pass.view_mask ? views : views.subspan(pass.first_view, 1);
  targets_.begin_pass(commands, target, pass.view_mask, data_.passthrough ? surround : scene.background);
  set_viewport(commands, drawn.front().viewport);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_.pipeline, 0, slot.set,
                              static_cast<std::uint32_t>(pass.views_at));
  if (data_.passthrough) record_passthrough(slot, pipelines);
  models_.record(commands, layouts_, pipelines, eye_of(drawn));
  if (data_.passthrough && scene.fingers) seen.fingers.draw(commands, layouts_, pipelines, surface_);
  record_overlay(slot, pipelines);
  if (views.size() == 1) gui_.record(commands, slot.arena.handle(), views.front().viewport, scene.gui);
  targets_.end_pass(commands, target, static_cast<std::uint32_t>(pass.first_view));
}

void FrameRecorder::record_passthrough(const FrameSlot& slot, const Pipelines& pipelines) const {
  slot.commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.passthrough);
  const auto columns = static_cast<std::uint32_t>(surface_.columns_used());
  slot.commands.draw(2 * (columns + 1), static_cast<std::uint32_t>(surface_.rows_used()), 0, 0);
}

void FrameRecorder::record_overlay(const FrameSlot& slot, const Pipelines& pipelines) const {
  const auto& commands = slot.commands;
  const auto bind = vk::PipelineBindPoint::eGraphics;
  if (const auto count = static_cast<std::uint32_t>(overlay_.lines().size())) {
    commands.bindPipeline(bind, *pipelines.line);
    commands.bindVertexBuffers(0, slot.arena.handle(), vk::DeviceSize{data_.lines_at});
    commands.draw(4, count, 0, 0);
  }
  const auto count = static_cast<std::uint32_t>(overlay_.quads().size()), tested = overlay_.tested();
  if (count == 0) return;
  commands.bindVertexBuffers(0, slot.arena.handle(), vk::DeviceSize{data_.quads_at});
  if (tested > 0) {
    commands.bindPipeline(bind, *pipelines.quad);
    commands.draw(4, tested, 0, 0);
  }
  if (count > tested) {
    commands.bindPipeline(bind, *pipelines.quad_on_top);
    commands.draw(4, count - tested, 0, tested);
  }
}

}  // namespace onestroke
