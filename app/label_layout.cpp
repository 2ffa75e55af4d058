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

double focal_of(const View& view) {
  return view.viewport.height / (view.fov.up - view.fov.down);
}

Placed place(const View& view, const LabelWish& wish, double em) {
  const Vec3 centre = inverse(view.T_world_view) * wish.centre_world;
  if (centre.z < nearest) return {};
  const double focal = focal_of(view), edge = edge_ems * em;
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

}  // namespace

CardPlace place_card(const View& view, std::string_view text, Vec3 centre_world, double reach, bool to_right) {
  const double em = text_em(view), focal = focal_of(view), edge = edge_ems * em;
  Vec3 centre = inverse(view.T_world_view) * centre_world;
  centre.z = std::max(centre.z, nearest);
  const TextSize size = measure(text);
  const double width = (static_cast<double>(size.width) + plate_width_ems) * em;
  const double height = (static_cast<double>(size.height) + plate_width_ems / 2) * em;
  const double u = (centre.x / centre.z - view.fov.left) * focal, v = (centre.y / centre.z + view.fov.up) * focal;
  const double clear = reach / centre.z * focal + gap_ems * em;
  // On the other side where this one has no room.
  const bool room_right = u + clear + width + edge<view.viewport.width, room_left = u - clear - width - edge> 0;
  const bool right = to_right ? room_right || !room_left : room_right && !room_left;
  const double left =
      std::clamp(right ? u + clear : u - clear - width, edge, std::max(edge, view.viewport.width - width - edge));
  const double top = std::clamp(v - height / 2, edge, std::max(edge, view.viewport.height - height - edge));
  const Vec3 in_view{(left / focal + view.fov.left) * centre.z, (top / focal - view.fov.up) * centre.z, centre.z};
  return {view.T_world_view * in_view, em};
}

void place_labels(const View& view, std::span<const LabelWish> wishes, std::span<std::optional<LabelPlace>> places) {
  constexpr std::size_t most = 2;
  std::array<Placed, most> placed;
  const std::size_t count = std::min({most, wishes.size(), places.size()});
  const double em = text_em(view), focal = focal_of(view);
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
