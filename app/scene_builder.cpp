#include "app/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

double focal_of(const View& view) {
  return view.viewport.height / (view.fov.up - view.fov.down);
}

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

double text_em(const View& view) {
  const double one_degree = focal_of(view) * std::tan(std::numbers::pi / 180);
  return std::max({14.0, view.viewport.height / 40.0, one_degree});
}

double pixel_at(const View& view, double depth) {
  return depth / focal_of(view);
}

}  // namespace onestroke
