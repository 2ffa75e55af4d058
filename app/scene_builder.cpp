#include "app/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

// Tangents of how far from straight ahead eyes read without the head's help, and how much of a lens is clear.
constexpr double most_across = 0.47, most_down = 0.36, edge_share = 0.8;

template <typename List>
auto span_of(const List& list) {
  return std::span(list.begin(), list.size());
}

}  // namespace

void SceneBuilder::clear() {
  instances.clear();
  lines.clear();
  labels.clear();
  gauges.clear();
  boxes.clear();
  texts.clear();
}

void SceneBuilder::give(FrameScene& scene) const {
  scene.instances = span_of(instances);
  scene.lines = span_of(lines);
  scene.labels = span_of(labels);
  scene.gauges = span_of(gauges);
  scene.boxes = span_of(boxes);
  scene.hud = span_of(texts);
}

Color faded(Color color, double opacity) {
  color.a *= static_cast<float>(opacity);
  return color;
}

Label label_on_top(std::string_view text, Vec3 position_world, double height_px, double opacity, Color plate) {
  return {.text = text,
          .position_world = position_world,
          .height_px = height_px,
          .color = faded(Color{}, opacity),
          .plate = faded(plate, opacity),
          .on_top = true};
}

double text_em(const View& view) {
  const double one_degree = focal_length_px(view) * std::tan(std::numbers::pi / 180);
  // A view that is wide and high before the eyes would have letters like a poster's.
  const double on_a_desk = std::min(view.viewport.height / 40.0, 1.6 * one_degree);
  return std::max({14.0, on_a_desk, one_degree});
}

HudArea hud_area(std::span<const View> views, bool worn) {
  const View& first = views.front();
  if (!worn) return {static_cast<double>(first.viewport.width), static_cast<double>(first.viewport.height), {}};
  double across = most_across, down = most_down;
  for (const View& view : views) {
    across = std::min({across, -edge_share * view.fov.left, edge_share * view.fov.right});
    down = std::min({down, -edge_share * view.fov.down, edge_share * view.fov.up});
  }
  const double width = 2 * focal_length_px(first) * across, height = 2 * focal_length_px(first) * down;
  return {width, height, HudPlate{.width = width, .height = height}};
}

double pixel_at(const View& view, double depth) {
  return depth / focal_length_px(view);
}

}  // namespace onestroke
