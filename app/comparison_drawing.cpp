#include "app/comparison_drawing.h"

namespace onestroke {
namespace {

constexpr Color ring_color{0.95F, 0.72F, 0.1F, 1}, line_color{1, 1, 1, 0.9F};

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

void draw_plane(SceneBuilder& scene, const View& view, const SectionPlane& plane, Vec3 middle, double reach,
                double opacity) {
  const Vec3 centre = middle + (plane.offset - dot(plane.normal, middle)) * plane.normal;
  // As level as the view is.
  const Vec3 down = rotate(view.T_world_view.rotation, {0, 1, 0});
  const Vec3 along = down - dot(down, plane.normal) * plane.normal;
  const Vec3 forward = rotate(view.T_world_view.rotation, {0, 0, 1});
  const Vec3 v = normalized(norm(along) > 0.1 ? along : forward - dot(forward, plane.normal) * plane.normal);
  const Vec3 u = cross(v, plane.normal);
  const std::array corners{centre + reach * (u + v), centre + reach * (u - v), centre - reach * (u + v),
                           centre - reach * (u - v)};
  for (std::size_t i = 0; i < corners.size(); ++i)
    scene.lines.push_back({corners[i], corners[(i + 1) % corners.size()], 2, faded(ring_color, 0.8 * opacity)});
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
    label(scene, view, words_[k - 1], 0.5 * (measure.points_world[k - 1] + measure.points_world[k]), false,
          measure.amount);
  }
  if (measure.count == 3) {
    words_[2].print("%.1f°", measure.angle_deg);
    label(scene, view, words_[2], measure.points_world[1], true, measure.amount);
  }
  if (measure.pick_progress > 0)
    scene.gauges.push_back(ring(measure.tip_world, 1.1 * em, measure.pick_progress, measure.amount));
}

void MeasureDrawing::label(SceneBuilder& scene, const View& view, const Text& words, Vec3 at, bool below,
                           double opacity) {
  const double em = text_em(view);
  scene.labels.push_back({.text = words.view(),
                          .position_world = above(view, at, below ? -0.6 * em : 0.6 * em),
                          .height_px = em,
                          .pivot_y = below ? 0.0 : 1.0,
                          .color = faded(Color{}, opacity),
                          .plate = faded(Label{}.plate, opacity),
                          .on_top = true});
}

}  // namespace onestroke
