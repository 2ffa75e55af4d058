#include "render/frame_data.h"

#include "render/projection.h"
#include "scene/frames.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace onestroke {

namespace {

gpu::vec4 rgba(const Color& c) {
  return {c.r, c.g, c.b, c.a};
}

gpu::vec4 vec4_of(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

gpu::SceneData scene_data(const Light& light, const PictureStore& picture, const DepthSurface& surface) {
  const PlaneBounds& b = surface.bounds();
  const int columns = surface.columns_used(), rows = surface.rows_used();
  const Intrinsics& k = picture.intrinsics();
  const double width = std::max(picture.width(), 1), height = std::max(picture.height(), 1);
  const auto& lens = picture.lens_placement();
  return {.surface = vec4_of(b.left, b.top, (b.right - b.left) / columns, (b.bottom - b.top) / rows),
          .surface_grid = vec4_of(columns, rows, 0, 0),
          .picture_intrinsic = vec4_of(k.fx / width, k.fy / height, k.cx / width, k.cy / height),
          .lens_map = {lens[0], lens[1], lens[2], lens[3]},
          .picture_shape = vec4_of(width / height, 0, 0, 0),
          .key_direction = gpu::vec4(glm::normalize(direction_to_graphics(light.to_key_world)), 0.0F),
          .key_color = rgba(light.key),
          .sky_color = rgba(light.sky),
          .ground_color = rgba(light.ground)};
}

template <typename T>
std::span<const T> one(const T& item) {
  return {&item, 1};
}

}  // namespace

void plan_passes(FrameData& data, std::span<const View> views, bool together) {
  data.pass_count = 0;
  if (together) {
    data.passes[data.pass_count++] = {.view_mask = (1U << views.size()) - 1};
    return;
  }
  for (std::size_t i = 0; i < views.size(); ++i) data.passes[data.pass_count++] = {.first_view = i};
}

void fill_arena(FrameData& data, Device& device, Arena& arena, const FrameScene& scene, std::span<const View> views,
                const PictureStore& picture, const DepthSurface& surface, const Overlay& overlay) {
  const auto& limits = device.properties().limits;
  const std::uint64_t alignment =
      std::max<std::uint64_t>({limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment, 16});
  constexpr std::uint64_t largest_gap = 256;
  arena.begin(device, max_views * (PASS_VIEWS * sizeof(gpu::ViewData) + largest_gap) + sizeof(gpu::SceneData) +
                          surface.inverse_depths().size_bytes() + overlay.quads().size_bytes() +
                          overlay.lines().size_bytes() + 4 * largest_gap);
  for (FramePass& pass : std::span(data.passes).first(data.pass_count)) {
    std::array<gpu::ViewData, PASS_VIEWS> seen{};
    const std::size_t count = pass.view_mask ? views.size() : 1;
    for (std::size_t i = 0; i < count; ++i) seen[i] = view_data(views[pass.first_view + i], picture.T_world_camera());
    pass.views_at = arena.put(std::span<const gpu::ViewData>(seen), alignment);
  }
  const gpu::SceneData shared = scene_data(scene.light, picture, surface);
  data.scene_at = arena.put(one(shared), alignment);
  data.surface_bytes = surface.inverse_depths().size_bytes();
  data.surface_at = arena.put(surface.inverse_depths(), alignment);
  data.quads_at = arena.put(overlay.quads());
  data.lines_at = arena.put(overlay.lines());
}

}  // namespace onestroke
