#include "scene/compare_menu.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

constexpr int columns = menu_columns, rows = static_cast<int>(menu_entries.size()) / columns;
static_assert(columns * rows == static_cast<int>(menu_entries.size()));
static_assert(menu_entries[CompareMenu::leave_entry].key == 'q');

// Hands are below what they point at.
constexpr double above_mm = 100;
constexpr double nearest_mm = 300, farthest_mm = 600;
// How far from the middle of the picture it may hang, as x / z and y / z.
constexpr double aside = 0.12, up = 0.12;

}  // namespace

Vec3 MenuView::place_of(std::size_t entry) {
  const int i = static_cast<int>(entry), column = i % columns, row = i / columns;
  return {(column - 0.5 * (columns - 1)) * CompareMenu::cell_width, (row - 0.5 * (rows - 1)) * CompareMenu::cell_height,
          0};
}

void CompareMenu::open(Vec3 place_world, const Pose& T_world_camera, Time now) {
  const Vec3 p = inverse(T_world_camera) * place_world;
  const double z = std::clamp(p.z, nearest_mm, farthest_mm);
  const Vec3 middle{std::clamp(p.x, -aside * z, aside * z), std::clamp(p.y - above_mm, -up * z, 0.0), z};
  view_.T_world_menu = {T_world_camera.rotation, T_world_camera * middle};
  open_ = true;
  sure_ = false;
  point_anew(now);
}

void CompareMenu::point_anew(Time now) {
  view_.pointed.reset();
  view_.progress = 0;
  by_tip_ = moved_ = false;
  met_.reset();
  used_ = now;
}

void CompareMenu::set_entry(std::size_t i, const MenuEntryView& entry) {
  view_.entries[i] = entry;
  if (!sure_) return;
  view_.entries[i].offered = i == sure_entry || i == leave_entry;
  if (i == sure_entry) view_.entries[i].words = "Leave";
  if (i == leave_entry) view_.entries[i].words = "Stay";
}

void CompareMenu::go_on(Time now) {
  by_tip_ = false;
  used_ = now;
  const std::size_t first = view_.pointed ? *view_.pointed + 1 : 0, count = view_.entries.size();
  for (std::size_t i = 0; i < count; ++i)
    if (const std::size_t entry = (first + i) % count; view_.entries[entry].offered) {
      view_.pointed = entry;
      return;
    }
}

std::optional<char> CompareMenu::pick(Time now) {
  if (!open_ || !view_.pointed || !view_.entries[*view_.pointed].offered) return std::nullopt;
  const std::size_t picked = *view_.pointed;
  if (picked == leave_entry && !sure_) {
    sure_ = true;
    point_anew(now);
    return std::nullopt;
  }
  close();
  if (!sure_) return menu_entries[picked].key;
  return picked == sure_entry ? std::optional(menu_entries[leave_entry].key) : std::nullopt;
}

bool CompareMenu::points_at(std::size_t entry, Vec3 place, double margin) const {
  const Vec3 from = place - MenuView::place_of(entry);
  return std::abs(from.x) < cell_width / 2 + margin && std::abs(from.y) < cell_height / 2 + margin;
}

std::optional<std::size_t> CompareMenu::entry_at(Vec3 place) const {
  for (std::size_t i = 0; i < view_.entries.size(); ++i)
    if (points_at(i, place, 0)) return i;
  return std::nullopt;
}

// Seen from the eye, since nobody can tell how deep a thing in the air hangs.
std::optional<Vec3> CompareMenu::on_menu(Vec3 tip_world, Vec3 eye_world) const {
  const Pose T_menu_world = inverse(view_.T_world_menu);
  const Vec3 eye = T_menu_world * eye_world, tip = T_menu_world * tip_world;
  if (eye.z >= 0 || tip.z <= eye.z) return std::nullopt;
  return eye + (-eye.z / (tip.z - eye.z)) * (tip - eye);
}

/// The entry that the tip points at: that of before, where it still does, or another.
std::optional<std::size_t> CompareMenu::find_pointed(Vec3 place) {
  if (!met_) met_ = place;
  moved_ = moved_ || norm(place - *met_) > moves_first;
  if (!moved_) return std::nullopt;
  const bool stays = by_tip_ && view_.pointed && points_at(*view_.pointed, place, hold_margin);
  const std::optional<std::size_t> entry = stays ? view_.pointed : entry_at(place);
  return entry && view_.entries[*entry].offered ? entry : std::nullopt;
}

std::optional<char> CompareMenu::update(const std::optional<Vec3>& tip_world, Vec3 eye_world, Duration step, Time now) {
  amount_.update(open_, step);
  view_.amount = amount_.value();
  if (!open_) return std::nullopt;
  const std::optional<Vec3> place = tip_world ? on_menu(*tip_world, eye_world) : std::nullopt;
  const std::optional<std::size_t> entry = place ? find_pointed(*place) : std::nullopt;
  if (!entry) {
    if (by_tip_ && now - seen_ > longest_gap) {
      by_tip_ = false;
      view_.pointed.reset();
      view_.progress = 0;
    }
    if (now - used_ > (sure_ ? unsure_for : unused_for)) close();
    return std::nullopt;
  }
  if (!by_tip_ || entry != view_.pointed) since_ = now;
  by_tip_ = true;
  view_.pointed = entry;
  view_.pointer_world = view_.T_world_menu * *place;
  used_ = seen_ = now;
  const Duration needed = sure_ && entry == sure_entry ? hold_to_leave : hold;
  view_.progress = std::clamp((now - since_).seconds() / needed.seconds(), 0.0, 1.0);
  return now - since_ < needed ? std::nullopt : pick(now);
}

}  // namespace onestroke
