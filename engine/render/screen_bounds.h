#pragma once

#include "render/vulkan.h"
#include "shaders/shared.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <span>

namespace onestroke {

/// A box with sides along the axes.
struct Box {
  glm::vec3 lower{INFINITY}, upper{-INFINITY};

  void add(const glm::vec3& point);
  glm::vec3 centre() const { return (lower + upper) * 0.5F; }
};

/// The rectangle of some views' viewport in which what is added may be seen; never too small. World: graphics axes,
/// metres.
class ScreenBounds {
 public:
  /// The views look through one and the same viewport, outlive this, and may yet turn by so many pixels.
  explicit ScreenBounds(std::span<const gpu::ViewData> views, float turn_px = 0) : views_(views), turn_px_(turn_px) {}

  /// A point, and so many pixels round it.
  void add(const glm::vec3& world, float margin_px);
  void add(const Box& box, const glm::mat4& world_from_box);

  /// Whole pixels of the target; of no size where nothing is seen.
  vk::Rect2D area() const;

 private:
  void add_pixel(const gpu::ViewData& view, const glm::vec4& clip, float margin_px);
  void add_everything();

  std::span<const gpu::ViewData> views_;
  float turn_px_;
  glm::vec2 lower_{INFINITY}, upper_{-INFINITY};  // pixels
};

}  // namespace onestroke
