#include "render/screen_bounds.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {

namespace {

// Clip w is the depth in metres. What is nearer than this has no bounds on the screen.
constexpr float nearest = 0.01F;

std::array<glm::vec4, 8> corners_of(const Box& box, const glm::mat4& clip_from_box) {
  std::array<glm::vec4, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = clip_from_box * glm::vec4(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                                           i & 4 ? box.upper.z : box.lower.z, 1.0F);
  return corners;
}

}  // namespace

void Box::add(const glm::vec3& point) {
  lower = glm::min(lower, point);
  upper = glm::max(upper, point);
}

void ScreenBounds::add_pixel(const gpu::ViewData& view, const glm::vec4& clip, float margin_px) {
  const glm::vec2 half(view.viewport.z / 2, view.viewport.w / 2);
  const glm::vec2 at = glm::vec2(view.viewport) + half + half * (glm::vec2(clip) / clip.w);
  lower_ = glm::min(lower_, at - margin_px);
  upper_ = glm::max(upper_, at + margin_px);
}

void ScreenBounds::add_everything() {
  lower_ = glm::vec2(-INFINITY);
  upper_ = glm::vec2(INFINITY);
}

void ScreenBounds::add(const glm::vec3& world, float margin_px) {
  for (const gpu::ViewData& view : views_) {
    const glm::vec4 clip = view.clip_from_world * glm::vec4(world, 1.0F);
    if (clip.w < nearest)
      add_everything();
    else
      add_pixel(view, clip, margin_px);
  }
}

void ScreenBounds::add(const Box& box, const glm::mat4& world_from_box) {
  for (const gpu::ViewData& view : views_) {
    const auto corners = corners_of(box, view.clip_from_world * world_from_box);
    const auto near = std::ranges::count_if(corners, [](const glm::vec4& clip) { return clip.w < nearest; });
    if (near == static_cast<std::ptrdiff_t>(corners.size())) continue;
    if (near > 0) add_everything();
    for (const glm::vec4& clip : corners)
      if (near == 0) add_pixel(view, clip, 0);
  }
}

vk::Rect2D ScreenBounds::area() const {
  const glm::vec4 viewport = views_.front().viewport;
  const glm::vec2 first(viewport), end = first + glm::vec2(viewport.z, viewport.w);
  // A pixel more on every side for what rounding may do.
  const glm::vec2 lower = glm::clamp(glm::floor(lower_ - turn_px_) - 1.0F, first, end);
  const glm::vec2 upper = glm::clamp(glm::ceil(upper_ + turn_px_) + 1.0F, first, end);
  if (!(lower.x < upper.x && lower.y < upper.y)) return {};
  return {{static_cast<std::int32_t>(lower.x), static_cast<std::int32_t>(lower.y)},
          {static_cast<std::uint32_t>(upper.x - lower.x), static_cast<std::uint32_t>(upper.y - lower.y)}};
}

}  // namespace onestroke
