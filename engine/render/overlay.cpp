#include "render/overlay.h"

#include "render/font.h"
#include "scene/frames.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

// Ems between a text and the edge of its plate.
constexpr float margin_x = 0.5F, margin_y = 0.22F, corner_radius = 0.36F;

// Of a ring in its radius, and of what it leaves of the ring behind on either side in its thickness.
constexpr float ring_thickness = 0.29F, ring_rim = 0.18F;

gpu::vec4 rgba(const Color& c) {
  return {c.r, c.g, c.b, c.a};
}

/// Ems.
TextSize plate_size(std::string_view text) {
  const TextSize size = measure(text);
  return {size.width + 2 * margin_x, size.height + 2 * margin_y};
}

}  // namespace

/// Where labels are seen from: graphics axes, metres.
struct Overlay::Frame {
  glm::vec3 eye, forward, right, down;
  float focal_px = 1;

  float depth(const glm::vec3& at) const { return glm::dot(at - eye, forward); }
  float distance(const Vec3& at) const { return glm::length(point_to_graphics(at) - eye); }
};

void Overlay::build(const FrameScene& scene, std::span<const View> views) {
  quads_.clear();
  lines_.clear();
  tested_ = 0;
  if (views.empty()) return;
  Vec3 middle;
  for (const auto& view : views) middle = middle + view.T_world_view.translation / static_cast<double>(views.size());
  const View& first = views.front();
  const Frame frame{.eye = point_to_graphics(middle),
                    .forward = direction_to_graphics(rotate(first.T_world_view.rotation, {0, 0, 1})),
                    .right = direction_to_graphics(rotate(first.T_world_view.rotation, {1, 0, 0})),
                    .down = direction_to_graphics(rotate(first.T_world_view.rotation, {0, 1, 0})),
                    .focal_px = static_cast<float>(focal_length_px(first))};

  sort_markings(scene, frame);
  for (const auto& marking : order_) {
    if (marking.label)
      add_label(*marking.label, frame);
    else
      add_gauge(*marking.gauge, frame);
    if (!marking.on_top()) tested_ = static_cast<std::uint32_t>(quads_.size());
  }
  const std::size_t first_on_screen = quads_.size();
  for (const auto& box : scene.boxes) add_box(box);
  for (const auto& text : scene.hud) add_hud(text);
  if (scene.hud_plate) hang_up(*scene.hud_plate, first_on_screen, frame);
  for (const auto& line : scene.lines)
    lines_.push_back({.from = {point_to_graphics(line.from_world), static_cast<float>(line.width_px)},
                      .to = {point_to_graphics(line.to_world), 1.0F},
                      .color = rgba(line.color)});
}

void Overlay::sort_markings(const FrameScene& scene, const Frame& frame) {
  order_.clear();
  for (const auto& label : scene.labels)
    order_.push_back({.distance = frame.distance(label.position_world), .label = &label, .gauge = nullptr});
  for (const auto& gauge : scene.gauges)
    order_.push_back({.distance = frame.distance(gauge.position_world), .label = nullptr, .gauge = &gauge});
  std::sort(order_.begin(), order_.end(), [](const Marking& a, const Marking& b) {
    return a.on_top() != b.on_top() ? b.on_top() : a.distance > b.distance;
  });
}

void Overlay::add_to(ScreenBounds& bounds) const {
  for (const auto& line : lines_)
    for (const gpu::vec4& end : {line.from, line.to}) bounds.add(glm::vec3(end), line.from.w / 2 + 1);
  for (const auto& quad : quads().first(tested_))
    for (const float x : {0.0F, 1.0F})
      for (const float y : {0.0F, 1.0F}) bounds.add(glm::vec3(quad.origin + x * quad.edge_x + y * quad.edge_y), 1);
}

void Overlay::add_label(const Label& label, const Frame& frame) {
  const glm::vec3 at = point_to_graphics(label.position_world);
  const float depth = frame.depth(at);
  if (depth <= 0) return;
  const float em = label.height_mm > 0 ? static_cast<float>(label.height_mm * metres_per_millimetre)
                                       : static_cast<float>(label.height_px) * depth / frame.focal_px;
  const TextSize size = plate_size(label.text);
  // Parallel to the screen rather than square to the line of sight: lines of text then stay level everywhere.
  const glm::vec3 x = frame.right * em, down = frame.down * em;
  const glm::vec3 corner =
      at - static_cast<float>(label.pivot_x) * size.width * x - static_cast<float>(label.pivot_y) * size.height * down;
  const gpu::QuadData plate{.origin = {corner, 0.0F},
                            .edge_x = {size.width * x, 0.0F},
                            .edge_y = {size.height * down, 0.0F},
                            .uv = {size.width, size.height, corner_radius, 0.0F},
                            .color = rgba(label.plate),
                            .shape = {QUAD_PLATE, 0.0F, 0.0F, 0.0F}};
  add_text(label.text, plate, label.color, size.width);
}

void Overlay::add_gauge(const Gauge& gauge, const Frame& frame) {
  const glm::vec3 at = point_to_graphics(gauge.position_world);
  const float depth = frame.depth(at);
  if (depth <= 0) return;
  const float metres_per_pixel = depth / frame.focal_px;
  const auto add = [&](float radius_px, float thickness_px, float share, const Color& color) {
    const glm::vec3 x = frame.right * radius_px * metres_per_pixel, down = frame.down * radius_px * metres_per_pixel;
    quads_.push_back({.origin = {at - x - down, 0.0F},
                      .edge_x = {2.0F * x, 0.0F},
                      .edge_y = {2.0F * down, 0.0F},
                      .uv = {2.0F, 2.0F, thickness_px / radius_px, share},
                      .color = rgba(color),
                      .shape = {QUAD_RING, 0.0F, 0.0F, 0.0F}});
  };
  const auto radius = static_cast<float>(gauge.radius_px);
  const float thickness = radius * ring_thickness, rim = thickness * ring_rim;
  if (gauge.back.a > 0) add(radius, thickness, 1, gauge.back);
  if (gauge.progress > 0)
    add(radius - rim, thickness - 2 * rim, static_cast<float>(std::min(gauge.progress, 1.0)), gauge.color);
}

/// From the screen into the world.
void Overlay::hang_up(const HudPlate& plate, std::size_t first, const Frame& frame) {
  const auto distance = static_cast<float>(plate.distance * metres_per_millimetre);
  const glm::vec3 right = frame.right * distance / frame.focal_px, down = frame.down * distance / frame.focal_px;
  const glm::vec3 corner = frame.eye + distance * frame.forward - static_cast<float>(plate.width / 2) * right -
                           static_cast<float>(plate.height / 2) * down;
  const auto in_world = [&](const gpu::vec4& pixels) { return pixels.x * right + pixels.y * down; };
  for (gpu::QuadData& quad : std::span(quads_).subspan(first)) {
    quad.origin = {corner + in_world(quad.origin), 0.0F};
    quad.edge_x = {in_world(quad.edge_x), 0.0F};
    quad.edge_y = {in_world(quad.edge_y), 0.0F};
  }
}

void Overlay::add_box(const HudBox& box) {
  // Boxes that touch may name their common edge in sums that are rounded differently.
  const auto whole = [](double pixels) { return static_cast<float>(std::floor(pixels + 0.5 + 1e-6)); };
  const float x = whole(box.x), y = whole(box.y), width = whole(box.x + box.width) - x,
              height = whole(box.y + box.height) - y;
  if (width <= 0 || height <= 0) return;
  quads_.push_back({.origin = {x, y, 0.0F, 1.0F},
                    .edge_x = {width, 0.0F, 0.0F, 0.0F},
                    .edge_y = {0.0F, height, 0.0F, 0.0F},
                    .uv = {width, height, 0.0F, 0.0F},
                    .color = rgba(box.color),
                    .shape = {QUAD_PLATE, 0.0F, 0.0F, 0.0F}});
}

void Overlay::add_hud(const HudText& text) {
  const TextSize size = plate_size(text.text);
  const auto em = static_cast<float>(text.height_px);
  // Whole pixels keep small text crisp.
  const float x = std::round(static_cast<float>(text.x) - static_cast<float>(text.pivot_x) * size.width * em);
  const float y = std::round(static_cast<float>(text.y) - static_cast<float>(text.pivot_y) * size.height * em);
  const gpu::QuadData plate{.origin = {x, y, 0.0F, 1.0F},
                            .edge_x = {size.width * em, 0.0F, 0.0F, 0.0F},
                            .edge_y = {0.0F, size.height * em, 0.0F, 0.0F},
                            .uv = {size.width, size.height, corner_radius, 0.0F},
                            .color = rgba(text.plate),
                            .shape = {QUAD_PLATE, 0.0F, 0.0F, 0.0F}};
  add_text(text.text, plate, text.color, size.width);
}

void Overlay::add_text(std::string_view text, const gpu::QuadData& plate, const Color& color, float em_width) {
  if (plate.color.a > 0) quads_.push_back(plate);
  const gpu::vec4 x = plate.edge_x / em_width, y = plate.edge_y / plate.uv.y;
  const gpu::vec4 start = plate.origin + margin_x * x + margin_y * y;
  lay_out(text, [&](const Glyph& glyph, float pen_x, float pen_y) {
    quads_.push_back({.origin = start + (pen_x + glyph.left) * x + (pen_y + glyph.top) * y,
                      .edge_x = (glyph.right - glyph.left) * x,
                      .edge_y = (glyph.bottom - glyph.top) * y,
                      .uv = {glyph.u0, glyph.v0, glyph.u1, glyph.v1},
                      .color = rgba(color),
                      .shape = {QUAD_GLYPH, 0.0F, 0.0F, 0.0F}});
  });
}

}  // namespace onestroke
