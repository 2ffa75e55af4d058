#include "app/comparison_drawing.h"

namespace onestroke {
namespace {

constexpr Color ring_color{0.95F, 0.72F, 0.1F, 1}, line_color{1, 1, 1, 0.9F};
constexpr Color pointed_plate{0.01F, 0.06F, 0.16F, 0.95F};
constexpr double menu_text_mm = 9;

/// So many pixels above a place, as the view sees it.
Vec3 above(const View& view, Vec3 place_world, double pixels) {
  Vec3 in_view = inverse(view.T_world_view) * place_world;
  in_view.y -= pixels * pixel_at(view, in_view.z);
  return view.T_world_view * in_view;
}

/// Above its place by so many pixels, or below it where they are less than zero.
void add_label(SceneBuilder& scene, const View& view, std::string_view words, Vec3 place_world, double above_px,
               double opacity) {
  Label label = label_on_top(words, above(view, place_world, above_px), text_em(view), opacity);
  label.pivot_y = above_px < 0 ? 0 : 1;
  scene.labels.push_back(label);
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
  add_label(scene, view, offer.words, offer.place_world, radius + 0.5 * em, 1);
}

void draw_menu(SceneBuilder& scene, const View& view, const MenuView& menu) {
  if (menu.amount <= 0) return;
  const auto add = [&](std::string_view words, Vec3 place, double opacity, const Color& plate) {
    Label label = label_on_top(words, menu.T_world_menu * place, 0, opacity * menu.amount, plate);
    label.height_mm = menu_text_mm;
    label.height_px = 0;
    scene.labels.push_back(label);
  };
  const Vec3 above = MenuView::place_of(menu_columns / 2) - Vec3{0, CompareMenu::cell_height, 0};
  add("Hold the red tip on an entry", above, 1, {0, 0, 0, 0});
  for (std::size_t i = 0; i < menu.entries.size(); ++i)
    add(menu.entries[i].words, MenuView::place_of(i), menu.entries[i].offered ? 1 : 0.25,
        menu.pointed == i ? pointed_plate : Label{}.plate);
  // Before the words.
  const Vec3 pointer = menu.pointer_world - rotate(menu.T_world_menu.rotation, {0, 0, menu_text_mm});
  if (menu.progress > 0) scene.gauges.push_back(ring(pointer, 1.1 * text_em(view), menu.progress, menu.amount));
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
  const double em = text_em(view), clear = 0.6 * em;
  for (int i = 0; i < measure.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    scene.gauges.push_back(ring(measure.points_world[k], 0.35 * em, 1, measure.amount));
    if (i == 0) continue;
    scene.lines.push_back(
        {measure.points_world[k - 1], measure.points_world[k], 2.5, faded(line_color, measure.amount)});
    words_[k - 1].print("%.1f mm", i == 1 ? measure.distance : measure.distance_2);
    add_label(scene, view, words_[k - 1].view(), 0.5 * (measure.points_world[k - 1] + measure.points_world[k]), clear,
              measure.amount);
  }
  if (measure.count == 3) {
    words_[2].print("%.1f°", measure.angle_deg);
    add_label(scene, view, words_[2].view(), measure.points_world[1], -clear, measure.amount);
  }
  if (measure.pick_progress > 0)
    scene.gauges.push_back(ring(measure.tip_world, 1.1 * em, measure.pick_progress, measure.amount));
}

}  // namespace onestroke
