#include "app/label_layout.h"

#include "app/scene_builder.h"
#include "render/font.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace onestroke {
namespace {

constexpr double nearest = 30;                          // mm
constexpr double gap_ems = 0.7, edge_ems = 0.5;         // from the ball, from the view's edge
constexpr double plate_width_ems = 1, line_ems = 1.75;  // the plate is wider than its text; its height with a gap
constexpr double leads_to = 0.5;                        // of the reach, above the centre
constexpr double lift_within_ems = 2;                   // two labels that come so close begin to make way

/// Pixels of the viewport, from its top left corner.
struct Placed {
  bool seen = false;
  double u = 0, v = 0, width = 0, depth = 0;
  Vec3 leader_view;
};

Placed place(const View& view, const LabelWish& wish, double em) {
  const Vec3 centre = inverse(view.T_world_view) * wish.centre_world;
  if (centre.z < nearest) return {};
  const double focal = focal_length_px(view), edge = edge_ems * em;
  Placed p;
  p.seen = true;
  p.width = (static_cast<double>(measure(wish.text).width) + plate_width_ems) * em;
  p.depth = centre.z;
  p.leader_view = centre - Vec3{0, leads_to * wish.reach, 0};
  p.u = (centre.x / centre.z - view.fov.left) * focal;
  p.v = (centre.y / centre.z + view.fov.up) * focal - wish.reach / centre.z * focal - gap_ems * em;
  const double half = p.width / 2 + edge;
  p.u = std::clamp(p.u, half, std::max(half, view.viewport.width - half));
  p.v = std::clamp(p.v, line_ems * em + edge, std::max(line_ems * em + edge, view.viewport.height - edge));
  return p;
}

/// 0 where the labels are clear of each other sideways, 1 where they are not. While it is between, either height is
/// right.
double crowding(const Placed& a, const Placed& b, double em) {
  const double apart = std::abs(a.u - b.u) - (a.width + b.width) / 2;
  return std::clamp(1 - apart / (lift_within_ems * em), 0.0, 1.0);
}

struct Beside {
  double depth, u, v, clear;  // of the ball: px, and how far a card stays away from its middle
  double width, height, edge;
};

Beside beside(const View& view, const LabelWish& card) {
  const double em = text_em(view), focal = focal_length_px(view);
  Vec3 centre = inverse(view.T_world_view) * card.centre_world;
  centre.z = std::max(centre.z, nearest);
  const TextSize size = measure(card.text);
  return {.depth = centre.z,
          .u = (centre.x / centre.z - view.fov.left) * focal,
          .v = (centre.y / centre.z + view.fov.up) * focal,
          .clear = card.reach / centre.z * focal + gap_ems * em,
          .width = (static_cast<double>(size.width) + plate_width_ems) * em,
          .height = (static_cast<double>(size.height) + plate_width_ems / 2) * em,
          .edge = edge_ems * em};
}

}  // namespace

bool card_fits_right(const View& view, const LabelWish& card, bool wanted) {
  const Beside b = beside(view, card);
  const bool right = b.u + b.clear + b.width + b.edge<view.viewport.width, left = b.u - b.clear - b.width - b.edge> 0;
  return right == left ? wanted : right;
}

CardPlace place_card(const View& view, const LabelWish& card, bool to_right) {
  const Beside b = beside(view, card);
  const double focal = focal_length_px(view);
  const double left = std::clamp(to_right ? b.u + b.clear : b.u - b.clear - b.width, b.edge,
                                 std::max(b.edge, view.viewport.width - b.width - b.edge));
  const double top = std::clamp(b.v - b.height / 2, b.edge, std::max(b.edge, view.viewport.height - b.height - b.edge));
  const Vec3 in_view{(left / focal + view.fov.left) * b.depth, (top / focal - view.fov.up) * b.depth, b.depth};
  return {view.T_world_view * in_view, text_em(view)};
}

void place_labels(const View& view, std::span<const LabelWish> wishes, std::span<std::optional<LabelPlace>> places) {
  constexpr std::size_t most = 2;
  std::array<Placed, most> placed;
  const std::size_t count = std::min({most, wishes.size(), places.size()});
  const double em = text_em(view), focal = focal_length_px(view);
  for (std::size_t i = 0; i < count; ++i) placed[i] = place(view, wishes[i], em);
  if (count == 2 && placed[0].seen && placed[1].seen) {
    // To just above the other, or where it was if that is higher.
    const double above = std::min(placed[0].v, placed[1].v - line_ems * em);
    placed[0].v += crowding(placed[0], placed[1], em) * (above - placed[0].v);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Placed& p = placed[i];
    places[i].reset();
    if (!p.seen) continue;
    const Vec3 in_view{(p.u / focal + view.fov.left) * p.depth, (p.v / focal - view.fov.up) * p.depth, p.depth};
    places[i] = LabelPlace{view.T_world_view * in_view, view.T_world_view * p.leader_view, em};
  }
}

}  // namespace onestroke
