#include "render/frame_data.h"

#include "render/projection.h"

#include <algorithm>

namespace onestroke {

namespace {

gpu::vec4 vec4_of(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

gpu::PictureData picture_data(const SeenPicture& seen, const DepthSurface& surface, std::size_t depths_at,
                              float brightness) {
  const PictureStore& picture = seen.store;
  const SurfaceAxis &across = surface.across(), &down = surface.down();
  const Intrinsics& k = picture.intrinsics();
  const double width = std::max(picture.width(), 1), height = std::max(picture.height(), 1);
  const auto& lens = picture.lens_placement();
  const auto matte = seen.fingers.matte_from_picture(picture.width(), picture.height());
  gpu::PictureData data{};
  data.surface = vec4_of(across.from, down.from, across.step(), down.step());
  data.surface_around = vec4_of(across.outer_from, down.outer_from, across.outer_to, down.outer_to);
  data.surface_grid = vec4_of(across.cells, down.cells, static_cast<double>(depths_at), 0);
  data.intrinsic = vec4_of(k.fx / width, k.fy / height, k.cx / width, k.cy / height);
  data.lens_map = {lens[0], lens[1], lens[2], lens[3]};
  data.shape = {static_cast<float>(width / height), matte[0], matte[1], brightness};
  return data;
}

void set_light(gpu::SceneData& data, const RoomLight& light) {
  data.key_direction = gpu::vec4(light.to_key(), 0.0F);
  data.key_color = gpu::vec4(light.key(), 0.0F);
  for (std::size_t i = 0; i < light.matt().size(); ++i) data.matt[i] = gpu::vec4(light.matt()[i], 0.0F);
  data.tone = gpu::vec4(light.black(), 0.0F);
}

void set_grain(gpu::SceneData& data, const FrameParts& parts) {
  const PictureStore& picture = parts.pictures.first.store;
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
  std::size_t depths_at = 0;
  for (std::size_t i = 0; i < parts.pictures.count(); ++i) {
    data.pictures[i] = picture_data(parts.pictures.at(i), parts.surfaces[i], depths_at, parts.scene.picture_brightness);
    depths_at += parts.surfaces[i].inverse_depths().size();
  }
  set_light(data, parts.light);
  set_grain(data, parts);
  std::ranges::copy(parts.balls, data.balls);
  return data;
}

void fill_views(FramePass& pass, std::span<const View> views, const SeenPictures& pictures) {
  for (std::size_t i = 0; i < pass.view_count; ++i) {
    const std::size_t view = pass.first_view + i, picture = pictures.of_view(view, views.size());
    pass.views[i] = view_data(views[view], pictures.at(picture).store.T_world_camera());
    pass.views[i].picture.x = static_cast<float>(picture);
  }
}

template <typename T>
std::span<const T> one(const T& item) {
  return {&item, 1};
}

}  // namespace

void plan_passes(FrameData& data, std::span<const View> views, bool together, const SeenPictures& pictures) {
  const std::size_t at_once = together ? views.size() : 1;
  data.pass_count = 0;
  for (std::size_t first = 0; first < views.size(); first += at_once) {
    FramePass& pass = data.passes[data.pass_count++];
    pass = {.view_mask = together ? (1U << views.size()) - 1 : 0, .first_view = first, .view_count = at_once};
    fill_views(pass, views, pictures);
  }
}

void move_views(FrameData& data, Arena& arena, std::span<const View> views, const SeenPictures& pictures) {
  for (FramePass& pass : std::span(data.passes).first(data.pass_count)) {
    fill_views(pass, views, pictures);
    arena.replace(pass.views_at, std::span<const gpu::ViewData>(pass.views));
  }
}

void fill_arena(FrameData& data, Device& device, Arena& arena, const FrameParts& parts) {
  const auto& limits = device.properties().limits;
  const std::uint64_t alignment =
      std::max<std::uint64_t>({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, 16});
  constexpr std::uint64_t largest_gap = 256;
  arena.begin(device, max_views * (PASS_VIEWS * sizeof(gpu::ViewData) + largest_gap) + sizeof(gpu::SceneData) +
                          MOST_PICTURES * parts.surfaces[0].inverse_depths().size_bytes() +
                          parts.overlay.quads().size_bytes() + parts.overlay.lines().size_bytes() + 4 * largest_gap +
                          ImguiPass::bytes_of(parts.scene.gui));
  for (FramePass& pass : std::span(data.passes).first(data.pass_count))
    pass.views_at = arena.put(std::span<const gpu::ViewData>(pass.views), alignment);
  const gpu::SceneData shared = scene_data(parts);
  data.scene_at = arena.put(one(shared), alignment);
  data.surface_bytes = 0;
  for (std::size_t i = 0; i < parts.pictures.count(); ++i) {
    const auto depths = parts.surfaces[i].inverse_depths();
    const std::uint64_t at = arena.put(depths, i == 0 ? alignment : sizeof(float));
    if (i == 0) data.surface_at = at;
    data.surface_bytes += depths.size_bytes();
  }
  data.quads_at = arena.put(parts.overlay.quads());
  data.lines_at = arena.put(parts.overlay.lines());
}

}  // namespace onestroke
