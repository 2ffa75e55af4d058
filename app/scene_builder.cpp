#include "app/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

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
  return std::max({14.0, view.viewport.height / 40.0, one_degree});
}

double pixel_at(const View& view, double depth) {
  return depth / focal_length_px(view);
}

}  // namespace onestroke
