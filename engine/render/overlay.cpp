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
};

void Overlay::build(const FrameScene& scene, std::span<const View> views) {
  quads_.clear();
  lines_.clear();
  order_.clear();
  tested_ = 0;
  if (views.empty()) return;
  Vec3 middle;
  for (const auto& view : views) middle = middle + view.T_world_view.translation / static_cast<double>(views.size());
  const View& first = views.front();
  const Frame frame{.eye = point_to_graphics(middle),
                    .forward = direction_to_graphics(rotate(first.T_world_view.rotation, {0, 0, 1})),
                    .right = direction_to_graphics(rotate(first.T_world_view.rotation, {1, 0, 0})),
                    .down = direction_to_graphics(rotate(first.T_world_view.rotation, {0, 1, 0})),
                    .focal_px = static_cast<float>(first.viewport.height / (first.fov.up - first.fov.down))};

  for (const auto& label : scene.labels)
    order_.emplace_back(glm::length(point_to_graphics(label.position_world) - frame.eye), &label);
  std::sort(order_.begin(), order_.end(), [](const auto& a, const auto& b) {
    return a.second->on_top != b.second->on_top ? b.second->on_top : a.first > b.first;
  });
  for (const auto& [distance, label] : order_) {
    add_label(*label, frame);
    if (!label->on_top) tested_ = static_cast<std::uint32_t>(quads_.size());
  }
  for (const auto& text : scene.hud) add_hud(text);
  for (const auto& line : scene.lines)
    lines_.push_back({.from = {point_to_graphics(line.from_world), static_cast<float>(line.width_px)},
                      .to = {point_to_graphics(line.to_world), 1.0F},
                      .color = rgba(line.color)});
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
  const float depth = glm::dot(at - frame.eye, frame.forward);
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
