#pragma once

#include "core/pose.h"
#include "core/time.h"
#include "scene/compare_modes.h"
#include "scene/turning.h"

#include <array>
#include <optional>
#include <span>

namespace onestroke {

struct MenuEntryView {
  std::string_view words;
  bool offered = false;  ///< Means something in the mode.
};

/// The menu as it hangs in the world.
struct MenuView {
  double amount = 0;  ///< 0 where there is none; eased.
  Pose T_world_menu;  ///< The menu's middle; x to the right, y down, z away from the eyes; mm.
  std::array<MenuEntryView, menu_entries.size()> entries{};
  std::optional<std::size_t> pointed;  ///< The entry that is pointed at, by a tip or by key.
  double progress = 0;                 ///< 0 to 1, of its being picked by the tip.
  Vec3 pointer_world;                  ///< Where the tip points, on the menu; mm.

  /// An entry's middle in the menu's frame, mm.
  static Vec3 place_of(std::size_t entry);
};

/// A menu that hangs before the wearer. What is picked is pointed at with a tip, as the camera sees it, and held for a
/// while. Leaving asks once more, at another place. No allocation.
class CompareMenu {
 public:
  static constexpr double cell_width = 62, cell_height = 26;  ///< mm
  /// A tip may go so far outside the entry that it points at, mm.
  static constexpr double hold_margin = 4;
  /// What a tip meets when the menu comes is not meant, before it has moved by so much, mm.
  static constexpr double moves_first = 20;
  static constexpr Duration hold = Duration::from_ms(1000), hold_to_leave = Duration::from_ms(2000);
  static constexpr Duration longest_gap = Duration::from_ms(250);
  /// Closes when nothing was pointed at for so long; sooner where it asks whether to leave.
  static constexpr Duration unused_for = Duration::from_seconds(10), unsure_for = Duration::from_seconds(6);

  /// The entry that leaves, and the one that then must be picked as well, at the other end of the menu. The first says
  /// to stay meanwhile.
  static constexpr std::size_t leave_entry = menu_entries.size() - 1, sure_entry = 0;

  /// Opens above a place, where the camera sees all of it.
  void open(Vec3 place_world, const Pose& T_world_camera, Time now);
  void close() { open_ = false; }
  bool is_open() const { return open_; }
  /// By key: points at the next entry that is offered, or picks the one that is pointed at, as update() does.
  void go_on(Time now);
  std::optional<char> pick(Time now);

  /// What an entry says now, and whether it is offered.
  void set_entry(std::size_t i, const MenuEntryView& entry);
  /// One frame: the tip that points, nothing where it is out of sight. `now` does not go back. Returns the key of an
  /// entry once, when it is picked, and is closed then.
  std::optional<char> update(const std::optional<Vec3>& tip_world, Vec3 eye_world, Duration step, Time now);
  const MenuView& view() const { return view_; }

 private:
  std::optional<std::size_t> entry_at(Vec3 place) const;
  bool points_at(std::size_t entry, Vec3 place, double margin) const;
  std::optional<Vec3> on_menu(Vec3 tip_world, Vec3 eye_world) const;
  std::optional<std::size_t> find_pointed(Vec3 place);
  void point_anew(Time now);

  MenuView view_;
  Eased amount_;
  bool open_ = false, sure_ = false, by_tip_ = false, moved_ = false;
  std::optional<Vec3> met_;  // where the tip pointed when the menu came, on the menu
  Time used_, since_, seen_;
};

}  // namespace onestroke
