#include "render/frame_recorder.h"

#include "render/font.h"
#include "render/graphics_pipeline.h"
#include "render/multiview_probe.h"
#include "render/upload.h"
#include "scene/frames.h"

#include <algorithm>

namespace onestroke {

namespace {

using Layout = vk::ImageLayout;

// What is predicted for a head some milliseconds later differs by less, unless it is struck.
constexpr float farthest_move_px = 16;

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

vk::Rect2D area_of(const Viewport& v) {
  return {{v.x, v.y}, {static_cast<std::uint32_t>(v.width), static_cast<std::uint32_t>(v.height)}};
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
      depth_(device, layouts),
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

void FrameRecorder::build_surfaces(const FrameScene& scene, std::span<const View> views, const SeenPictures& pictures) {
  data_.passthrough = pictures.first.store.shown() && scene.passthrough_distance;
  if (!data_.passthrough) return;
  // From the camera's own place every depth looks the same.
  constexpr double same_place = 1e-3;  // mm
  bool aside = false;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const PictureStore& picture = pictures.at(pictures.of_view(i, views.size())).store;
    aside = aside || norm(views[i].T_world_view.translation - picture.T_world_camera().translation) > same_place;
  }
  for (std::size_t i = 0; i < pictures.count(); ++i) build_surface(i, scene, aside, pictures, false);
  // Views that are drawn at once have the same cells.
  if (pictures.count() == 1 || surfaces_[0].in_cells() == surfaces_[1].in_cells()) return;
  build_surface(surfaces_[0].in_cells() ? 1 : 0, scene, aside, pictures, true);
}

void FrameRecorder::build_surface(std::size_t i, const FrameScene& scene, bool aside, const SeenPictures& pictures,
                                  bool in_cells) {
  const PictureStore& picture = pictures.at(i).store;
  std::array<DepthSegment, DepthSurface::most_segments> moved;
  std::span<const DepthSegment> segments;
  if (aside) segments = scene.passthrough_segments;
  if (i > 0) {
    // The segments are in the first camera's frame.
    const Pose T_this_first = inverse(picture.T_world_camera()) * pictures.first.store.T_world_camera();
    const std::size_t count = std::min(segments.size(), moved.size());
    for (std::size_t k = 0; k < count; ++k) {
      moved[k] = segments[k];
      moved[k].from = T_this_first * moved[k].from;
      moved[k].to = T_this_first * moved[k].to;
    }
    segments = std::span(moved).first(count);
  }
  surfaces_[i].build(picture.inside(), picture.bounds(), segments, *scene.passthrough_distance, in_cells);
}

void FrameRecorder::move_views(FrameSlot& slot, std::span<const View> views, const SeenPictures& pictures) {
  onestroke::move_views(data_, slot.arena, views, pictures);
}

void FrameRecorder::find_foreground(FramePass& pass, float margin_px) const {
  ScreenBounds bounds(std::span(pass.views).first(pass.view_count), margin_px);
  models_.add_to(bounds);
  overlay_.add_to(bounds);
  pass.foreground = bounds.area();
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
  // Where there is no second picture nobody looks it up, but there must be something.
  const SeenPicture &first = seen.pictures.first, &second = seen.pictures.at(seen.pictures.count() - 1);
  const std::array images{
      sampled(first.store.view()),      sampled(second.store.view()),      sampled(glyphs_.view()),
      sampled(first.store.lens_view()), sampled(second.store.lens_view()), sampled(seen.lighting.view()),
      sampled(first.fingers.view()),    sampled(second.fingers.view()),    sampled(targets_.foreground())};
  // The images have neighbouring bindings, so one write fills them all.
  static_assert(MOST_PICTURES == 2);
  static_assert(BINDING_GLYPHS == BINDING_PICTURE + 1 && BINDING_LENS == BINDING_PICTURE + 2 &&
                BINDING_ROOM == BINDING_PICTURE + 3 && BINDING_FINGERS == BINDING_PICTURE + 4 &&
                BINDING_FOREGROUND == BINDING_PICTURE + 5);
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
  if (!targets_.foreground_depth()) return;
  const vk::DescriptorImageInfo depth{{}, targets_.foreground_depth(), Layout::eDepthStencilReadOnlyOptimal};
  device_.vk().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = slot.set,
                                                           .dstBinding = BINDING_DEPTH,
                                                           .descriptorCount = 1,
                                                           .descriptorType = Type::eSampledImage,
                                                           .pImageInfo = &depth},
                                    {});
}

void FrameRecorder::record(FrameSlot& slot, const FrameScene& scene, std::span<const View> views,
                           const RenderTarget& target, const Seen& seen, bool views_move) {
  plan_passes(data_, views, can_draw_together(views), seen.pictures);
  targets_.fit(target, static_cast<std::uint32_t>(data_.passes.front().view_count), slot.graveyard);
  models_.prepare(scene.instances, views);
  overlay_.build(scene, views);
  for (std::size_t i = 0; i < seen.pictures.count(); ++i) seen.pictures.at(i).record(slot);
  seen.lighting.record(slot, scene);
  build_surfaces(scene, views, seen.pictures);
  fill_arena(data_, device_, slot.arena,
             {scene, views, seen.pictures, seen.lighting.light(), surfaces_, overlay_, models_.balls()});
  gui_.put(slot.arena, scene.gui);
  write_set(slot, seen);
  FrameTargets::open(slot.commands, target);
  for (FramePass& pass : std::span(data_.passes).first(data_.pass_count)) {
    const auto drawn = views.subspan(pass.first_view, pass.view_count);
    const Pipelines& pipelines = pipelines_for(target, pass.view_mask);
    find_foreground(pass, views_move ? farthest_move_px : 0);
    slot.commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layouts_.pipeline, 0, slot.set,
                                     static_cast<std::uint32_t>(pass.views_at));
    if (pass.foreground.extent.width > 0) record_foreground(slot, pass, pipelines, drawn, scene, seen);
    record_picture(slot, pass, pipelines, drawn, target, scene, seen);
    if (views.size() == 1) gui_.record(slot.commands, slot.arena.handle(), drawn.front().viewport, scene.gui);
    slot.commands.endRendering();
    if (target.depth.image)
      depth_.record(slot.commands, target, pass, area_of(drawn.front().viewport),
                    data_.passthrough ? &surfaces_[0] : nullptr);
  }
  FrameTargets::close(slot.commands, target);
}

void FrameRecorder::record_foreground(const FrameSlot& slot, const FramePass& pass, const Pipelines& pipelines,
                                      std::span<const View> drawn, const FrameScene& scene, const Seen& seen) {
  const auto& commands = slot.commands;
  targets_.begin_foreground(commands, pass);
  set_viewport(commands, area_of(drawn.front().viewport));
  commands.setScissor(0, pass.foreground);
  models_.record(commands, layouts_, pipelines, pass.foreground, eye_of(drawn));
  for (std::size_t i = 0; data_.passthrough && scene.fingers && i < seen.pictures.count(); ++i)
    seen.pictures.at(i).fingers.draw(commands, layouts_, pipelines, surfaces_[i], i);
  if (const auto count = static_cast<std::uint32_t>(overlay_.lines().size())) {
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.line);
    commands.bindVertexBuffers(0, slot.arena.handle(), vk::DeviceSize{data_.lines_at});
    commands.draw(4, count, 0, 0);
  }
  record_quads(slot, *pipelines.quad, 0, overlay_.tested());
  targets_.end_foreground(commands);
}

void FrameRecorder::record_picture(const FrameSlot& slot, const FramePass& pass, const Pipelines& pipelines,
                                   std::span<const View> drawn, const RenderTarget& target, const FrameScene& scene,
                                   const Seen& seen) const {
  const auto& commands = slot.commands;
  const vk::Rect2D viewport = area_of(drawn.front().viewport);
  FrameTargets::begin_picture(commands, target, pass, viewport, data_.passthrough ? surround : scene.background);
  set_viewport(commands, viewport);
  const SeenPictures& pictures = seen.pictures;
  const bool ideal = pictures.first.store.ideal_lens() && pictures.at(pictures.count() - 1).store.ideal_lens();
  if (data_.passthrough) record_passthrough(slot, pipelines, ideal);
  if (pass.foreground.extent.width > 0) {
    commands.setScissor(0, pass.foreground);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.foreground);
    commands.draw(3, 1, 0, 0);
    commands.setScissor(0, viewport);
  }
  record_quads(slot, *pipelines.quad_on_top, overlay_.tested(), static_cast<std::uint32_t>(overlay_.quads().size()));
}

void FrameRecorder::record_passthrough(const FrameSlot& slot, const Pipelines& pipelines, bool ideal_lens) const {
  const auto& commands = slot.commands;
  const auto columns = static_cast<std::uint32_t>(surfaces_[0].across().cells);
  const auto rows = static_cast<std::uint32_t>(surfaces_[0].down().cells);
  // A row of cells is an instance, two vertices begin a column.
  const auto draw = [&commands](std::uint32_t column, std::uint32_t row, std::uint32_t across, std::uint32_t down) {
    commands.draw(2 * (across + 1), down, 2 * column, row);
  };
  const auto bind = vk::PipelineBindPoint::eGraphics;
  commands.bindPipeline(bind, ideal_lens ? *pipelines.passthrough : *pipelines.passthrough_lens);
  draw(1, 1, columns - 2, rows - 2);
  commands.bindPipeline(bind, *pipelines.passthrough_edge);
  draw(0, 0, columns, 1);
  draw(0, rows - 1, columns, 1);
  draw(0, 1, 1, rows - 2);
  draw(columns - 1, 1, 1, rows - 2);
}

void FrameRecorder::record_quads(const FrameSlot& slot, vk::Pipeline pipeline, std::uint32_t first,
                                 std::uint32_t end) const {
  if (first == end) return;
  slot.commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
  slot.commands.bindVertexBuffers(0, slot.arena.handle(), vk::DeviceSize{data_.quads_at});
  slot.commands.draw(4, end - first, 0, first);
}

}  // namespace onestroke
