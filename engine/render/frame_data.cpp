#include "render/frame_data.h"

#include "render/projection.h"

#include <algorithm>

namespace onestroke {

namespace {

gpu::vec4 vec4_of(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

void place_picture(gpu::SceneData& data, const PictureStore& picture, const DepthSurface& surface) {
  const SurfaceAxis &across = surface.across(), &down = surface.down();
  const Intrinsics& k = picture.intrinsics();
  const double width = std::max(picture.width(), 1), height = std::max(picture.height(), 1);
  const auto& lens = picture.lens_placement();
  data.surface = vec4_of(across.from, down.from, across.step(), down.step());
  data.surface_around = vec4_of(across.outer_from, down.outer_from, across.outer_to, down.outer_to);
  data.surface_grid = vec4_of(across.cells, down.cells, 0, 0);
  data.picture_intrinsic = vec4_of(k.fx / width, k.fy / height, k.cx / width, k.cy / height);
  data.lens_map = {lens[0], lens[1], lens[2], lens[3]};
  data.picture_shape = vec4_of(width / height, 0, 0, 0);
}

void set_light(gpu::SceneData& data, const RoomLight& light) {
  data.key_direction = gpu::vec4(light.to_key(), 0.0F);
  data.key_color = gpu::vec4(light.key(), 0.0F);
  for (std::size_t i = 0; i < light.matt().size(); ++i) data.matt[i] = gpu::vec4(light.matt()[i], 0.0F);
  data.tone = gpu::vec4(light.black(), 0.0F);
}

void set_grain(gpu::SceneData& data, const FrameParts& parts) {
  const PictureStore& picture = parts.picture;
  if (!parts.scene.grain || !picture.shown() || !parts.scene.passthrough_distance) return;
  const View& view = parts.views.front();
  const double view_focal = focal_length_px(view);
  data.tone.w = parts.light.noise();
  // A seed that a float holds to the last.
  constexpr std::uint64_t seeds = 1U << 20U;
  data.grain = vec4_of(picture.intrinsics().fy / view_focal, static_cast<double>(picture.sequence() % seeds), 0, 0);
}

gpu::SceneData scene_data(const FrameParts& parts) {
  gpu::SceneData data{};
  place_picture(data, parts.picture, parts.surface);
  set_light(data, parts.light);
  set_grain(data, parts);
  std::ranges::copy(parts.balls, data.balls);
  data.picture_shape.y = parts.matte_from_picture[0];
  data.picture_shape.z = parts.matte_from_picture[1];
  data.picture_shape.w = parts.scene.picture_brightness;
  return data;
}

template <typename T>
std::span<const T> one(const T& item) {
  return {&item, 1};
}

}  // namespace

void plan_passes(FrameData& data, std::span<const View> views, bool together, const Pose& T_world_camera) {
  const std::size_t at_once = together ? views.size() : 1;
  data.pass_count = 0;
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    FramePass& pass = data.passes[data.pass_count++];
    pass = {.view_mask = together ? (1U << views.size()) - 1 : 0, .first_view = first, .view_count = at_once};
    for (std::size_t i = 0; i < at_once; ++i) pass.views[i] = view_data(views[first + i], T_world_camera);
  }
}

void move_views(FrameData& data, Arena& arena, std::span<const View> views, const Pose& T_world_camera) {
  for (FramePass& pass : std::span(data.passes).first(data.pass_count)) {
    for (std::size_t i = 0; i < pass.view_count; ++i)
      pass.views[i] = view_data(views[pass.first_view + i], T_world_camera);
    arena.replace(pass.views_at, std::span<const gpu::ViewData>(pass.views));
  }
}

void fill_arena(FrameData& data, Device& device, Arena& arena, const FrameParts& parts) {
  const auto& limits = device.properties().limits;
  const std::uint64_t alignment =
      std::max<std::uint64_t>({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, 16});
  constexpr std::uint64_t largest_gap = 256;
  arena.begin(device, max_views * (PASS_VIEWS * sizeof(gpu::ViewData) + largest_gap) + sizeof(gpu::SceneData) +
                          parts.surface.inverse_depths().size_bytes() + parts.overlay.quads().size_bytes() +
                          parts.overlay.lines().size_bytes() + 4 * largest_gap + ImguiPass::bytes_of(parts.scene.gui));
  for (FramePass& pass : std::span(data.passes).first(data.pass_count))
    pass.views_at = arena.put(std::span<const gpu::ViewData>(pass.views), alignment);
  const gpu::SceneData shared = scene_data(parts);
  data.scene_at = arena.put(one(shared), alignment);
  data.surface_bytes = parts.surface.inverse_depths().size_bytes();
  data.surface_at = arena.put(parts.surface.inverse_depths(), alignment);
  data.quads_at = arena.put(parts.overlay.quads());
  data.lines_at = arena.put(parts.overlay.lines());
}

}  // namespace onestroke
