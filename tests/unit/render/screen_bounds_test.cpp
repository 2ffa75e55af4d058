#include "render/screen_bounds.h"

#include "render/projection.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <random>

namespace onestroke {
namespace {

constexpr Viewport viewport{.x = 100, .y = 40, .width = 640, .height = 480};

gpu::ViewData view_at(double x) {
  return view_data({.T_world_view = {{}, {x, 0, 0}},
                    .fov = {.left = -0.5, .right = 0.45, .up = 0.4, .down = -0.35},
                    .viewport = viewport},
                   {});
}

glm::vec2 pixel_of(const gpu::ViewData& view, const glm::vec3& world) {
  const glm::vec4 clip = view.clip_from_world * glm::vec4(world, 1.0F);
  return {viewport.x + (clip.x / clip.w + 1) / 2 * viewport.width,
          viewport.y + (clip.y / clip.w + 1) / 2 * viewport.height};
}

bool holds(const vk::Rect2D& area, const glm::vec2& pixel) {
  const glm::vec2 first(area.offset.x, area.offset.y);
  const glm::vec2 end = first + glm::vec2(area.extent.width, area.extent.height);
  return pixel.x >= first.x && pixel.y >= first.y && pixel.x <= end.x && pixel.y <= end.y;
}

bool in_viewport(const glm::vec2& pixel) {
  return holds({{viewport.x, viewport.y}, {viewport.width, viewport.height}}, pixel);
}

TEST(ScreenBounds, AreEmptyWhereNothingWasAdded) {
  const std::array views{view_at(0)};
  EXPECT_EQ(ScreenBounds(views).area().extent.width, 0U);
}

TEST(ScreenBounds, AreAPixelWiderThanAPoint) {
  const std::array views{view_at(0)};
  ScreenBounds bounds(views);
  const glm::vec3 point(0.01F, -0.02F, -0.5F);
  bounds.add(point, 3);
  const vk::Rect2D area = bounds.area();
  const glm::vec2 pixel = pixel_of(views[0], point);
  EXPECT_TRUE(holds(area, pixel - 3.0F));
  EXPECT_TRUE(holds(area, pixel + 3.0F));
  EXPECT_LE(area.extent.width, 10U);
  EXPECT_LE(area.extent.height, 10U);
}

TEST(ScreenBounds, HoldAllOfABoxInEveryView) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> turn(-3, 3), aside(-0.4F, 0.4F), depth(-1.0F, 0.1F), share(0, 1);
  const std::array views{view_at(-30), view_at(30)};
  int seen = 0, narrow = 0;
  for (int i = 0; i < 500; ++i) {
    const Box box{{-0.02F, -0.05F, -0.03F}, {0.06F, 0.01F, 0.02F}};
    glm::mat4 m = glm::translate(glm::mat4(1), {aside(random), aside(random), depth(random)});
    m = glm::rotate(glm::rotate(m, turn(random), {1, 0, 0}), turn(random), {0, 1, 0});
    ScreenBounds bounds(views);
    bounds.add(box, m);
    const vk::Rect2D area = bounds.area();
    EXPECT_TRUE(area.extent.width == 0 || area.offset.x >= viewport.x);
    EXPECT_LE(area.offset.x + static_cast<int>(area.extent.width), viewport.x + viewport.width);
    for (int k = 0; k < 50; ++k) {
      const glm::vec3 inner = glm::mix(box.lower, box.upper, glm::vec3(share(random), share(random), share(random)));
      const glm::vec3 world(m * glm::vec4(inner, 1.0F));
      for (const auto& view : views) {
        if (world.z > -0.02F || !in_viewport(pixel_of(view, world))) continue;
        ++seen;
        EXPECT_TRUE(holds(area, pixel_of(view, world)));
      }
    }
    narrow += area.extent.width < viewport.width / 2 ? 1 : 0;
  }
  EXPECT_GT(seen, 5000);
  EXPECT_GT(narrow, 250);
}

TEST(ScreenBounds, AreTheWholeViewportWhereSomethingReachesUpToTheEye) {
  const std::array views{view_at(0)};
  ScreenBounds bounds(views);
  bounds.add(Box{{-0.01F, -0.01F, -0.5F}, {0.01F, 0.01F, 0.1F}}, glm::mat4(1));
  EXPECT_EQ(bounds.area(), (vk::Rect2D{{viewport.x, viewport.y}, {viewport.width, viewport.height}}));
}

TEST(ScreenBounds, LeaveOutWhatIsBehindTheEye) {
  const std::array views{view_at(0)};
  ScreenBounds bounds(views);
  bounds.add(Box{{-0.01F, -0.01F, 0.1F}, {0.01F, 0.01F, 0.2F}}, glm::mat4(1));
  EXPECT_EQ(bounds.area().extent.width, 0U);
}

}  // namespace
}  // namespace onestroke
