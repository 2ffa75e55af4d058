#include "app/comparison_drawing.h"

namespace onestroke {
namespace {

constexpr Color ring_color{0.95F, 0.72F, 0.1F, 1}, point_color{0.95F, 0.72F, 0.1F, 1}, line_color{1, 1, 1, 0.9F};

/// So many pixels above a place, as the view sees it.
Vec3 above(const View& view, Vec3 place_world, double pixels) {
  Vec3 in_view = inverse(view.T_world_view) * place_world;
  in_view.y -= pixels * pixel_at(view, in_view.z);
  return view.T_world_view * in_view;
}

Gauge ring(Vec3 place, double radius_px, double progress, double opacity = 1) {
  Gauge gauge;
  gauge.position_world = place;
  gauge.radius_px = radius_px;
  gauge.progress = progress;
  gauge.color = faded(ring_color, opacity);
  gauge.back = faded(gauge.back, opacity);
  gauge.on_top = true;
  return gauge;
}

}  // namespace

void draw_offer(SceneBuilder& scene, const View& view, const OfferView& offer) {
  const double em = text_em(view), radius = 1.1 * em;
  scene.gauges.push_back(ring(offer.place_world, radius, offer.progress));
  if (offer.words.empty()) return;
  scene.labels.push_back({.text = offer.words,
                          .position_world = above(view, offer.place_world, radius + 0.5 * em),
                          .height_px = em,
                          .pivot_y = 1,
                          .on_top = true});
}

void MeasureDrawing::draw(SceneBuilder& scene, const View& view, const MeasureView& measure) {
  if (measure.amount <= 0) return;
  const double em = text_em(view);
  for (int i = 0; i < measure.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    scene.gauges.push_back(ring(measure.points_world[k], 0.35 * em, 1, measure.amount));
    if (i == 0) continue;
    scene.lines.push_back(
        {measure.points_world[k - 1], measure.points_world[k], 2.5, faded(line_color, measure.amount)});
    words_[k - 1].print("%.1f mm", i == 1 ? measure.distance : measure.distance_2);
    label(scene, view, words_[k - 1], 0.5 * (measure.points_world[k - 1] + measure.points_world[k]), measure.amount);
  }
  if (measure.count == 3) {
    words_[2].print("%.1f°", measure.angle_deg);
    label(scene, view, words_[2], measure.points_world[1], measure.amount);
  }
  if (measure.pick_progress > 0)
    scene.gauges.push_back(ring(measure.tip_world, 1.1 * em, measure.pick_progress, measure.amount));
}

void MeasureDrawing::label(SceneBuilder& scene, const View& view, const Text& words, Vec3 at, double opacity) {
  const double em = text_em(view);
  scene.labels.push_back({.text = words.view(),
                          .position_world = above(view, at, 0.6 * em),
                          .height_px = em,
                          .pivot_y = 1,
                          .color = faded(Color{}, opacity),
                          .plate = faded(Label{}.plate, opacity),
                          .on_top = true});
}

}  // namespace onestroke
