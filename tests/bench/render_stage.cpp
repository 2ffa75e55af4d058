#include "render_stage.h"

#include "core/error.h"
#include "scene/mesh_levels.h"
#include "scene/model.h"

#include <cmath>
#include <numbers>

namespace onestroke::bench {

namespace {

constexpr double fov = 0.9;  // radians, horizontal
constexpr auto format = vk::Format::eR8G8B8A8Srgb;

std::size_t bytes_a_row(int width, PixelFormat pixels) {
  const auto w = static_cast<std::size_t>(width);
  if (pixels == PixelFormat::rgb8) return 3 * w;
  return pixels == PixelFormat::yuyv ? 2 * w : w;
}

/// A ball that is wavy, so that no two triangles face the same way; with levels of detail, as the program loads it.
Model wavy_ball(int triangles) {
  const auto across = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
  const std::uint32_t around = 2 * across;
  Model model;
  model.name = "wavy ball";
  for (std::uint32_t i = 0; i <= around; ++i)
    for (std::uint32_t j = 0; j <= across; ++j) {
      const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(around);
      const float b = std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(across);
      const std::array<float, 3> n{std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a)};
      const float radius = 0.04F + 0.003F * std::sin(9 * a) * std::sin(9 * b);
      model.vertices.push_back({.position = {radius * n[0], radius * n[1], radius * n[2]},
                                .normal = n,
                                .tangent = {-std::sin(a), 0, std::cos(a), 1},
                                .uv = {a, b},
                                .color = {1, 1, 1, 1}});
    }
  const std::uint32_t row = across + 1;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t at = i * row + j;
      model.indices.insert(model.indices.end(), {at, at + row, at + 1, at + 1, at + row, at + row + 1});
    }
  model.materials = {{.base_color = {0.7F, 0.4F, 0.2F, 1}, .metallic = 0.2F, .roughness = 0.5F}};
  model.parts = {{.first_index = 0, .index_count = static_cast<std::uint32_t>(model.indices.size()), .material = 0}};
  add_levels(model);
  return model;
}

Matrix4 placed_at(float x, float y) {
  Matrix4 m = identity_matrix;
  m[12] = x;
  m[13] = y;
  m[14] = -0.3F;
  return m;
}

}  // namespace

BenchPicture::BenchPicture(int width, int height, PixelFormat pixels) {
  const std::size_t stride = bytes_a_row(width, pixels), rows = static_cast<std::size_t>(height);
  const bool two_planes = pixels == PixelFormat::nv12;
  bytes_.resize(stride * (two_planes ? rows + (rows + 1) / 2 : rows));
  for (std::size_t i = 0; i < bytes_.size(); ++i) bytes_[i] = static_cast<std::uint8_t>(i * 7 + i / stride * 3);
  picture_.width = width;
  picture_.height = height;
  picture_.format = pixels;
  picture_.planes[0] = bytes_.data();
  picture_.strides[0] = stride;
  if (two_planes) {
    picture_.planes[1] = bytes_.data() + stride * rows;
    picture_.strides[1] = stride;
  }
  picture_.intrinsics = Intrinsics::from_fov(width, height, fov);
}

RenderStage::RenderStage(Gpu& gpu, int width, int height, int views, bool multiview)
    : gpu_(gpu),
      target_(*gpu.device(), format, width, height, views, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
      floor_(*gpu.device(), target_.target()),
      renderer_(gpu, {.multiview = multiview}) {
  frame_.should_render = true;
  frame_.target = &target_.target();
  frame_.view_count = views;
  for (int i = 0; i < views; ++i) {
    View& view = frame_.views[static_cast<std::size_t>(i)];
    view.fov = fov_of(Intrinsics::from_fov(width, height, fov), width, height);
    view.viewport = {0, 0, width, height};
    if (views == 2) view.T_world_view.translation.x = (i - 0.5) * 63;
  }
}

void RenderStage::draw(const FrameScene& scene) {
  if (!renderer_.draw(scene, frame_)) throw Error(renderer_.failure());
  gpu_.wait();
}

FrameScene RenderStage::scene_of(int count, int triangles) {
  const auto [at, fresh] = models_.try_emplace(triangles);
  if (fresh) at->second = renderer_.load(wavy_ball(triangles));
  instances_.clear();
  for (int i = 0; i < count; ++i)
    instances_.push_back({.model = at->second,
                          .world_graphics_from_model = placed_at(count == 1 ? 0
                                                                 : i % 2    ? 0.045F
                                                                            : -0.045F,
                                                                 count < 3 ? 0
                                                                 : i < 2   ? 0.03F
                                                                           : -0.03F)});
  return {.passthrough_distance = 300, .instances = instances_};
}

}  // namespace onestroke::bench
