#include "scene/comparison.h"

#include <algorithm>

namespace onestroke {

namespace {

// Where the menu comes without a stick in sight, as the camera sees it.
constexpr Vec3 usual_place{0, 60, 400};

}  // namespace

void Comparison::toggle_menu() {
  if (menu_.is_open()) {
    menu_.close();
    return;
  }
  menu_hand_ = hands_[preferred()].held ? preferred() : other(preferred());
  Vec3 sum;
  int seen = 0;
  for (const Hand h : both_hands) {
    if (!hands_[h].visible()) continue;
    sum = sum + hands_[h].T_world_marker * place_of(carried_by(h).points, StickPoint::arm);
    ++seen;
  }
  menu_.open(seen > 0 ? sum / seen : T_world_camera_ * usual_place, T_world_camera_, now_);
  // What is pointed at next must be one that the mode has.
  fill_menu_entries();
}

void Comparison::press_menu_key(char key) {
  if (!menu_.is_open()) {
    toggle_menu();
    return;
  }
  if (key == next_entry) menu_.go_on(now_);
  if (key == pick_entry)
    if (const std::optional<char> picked = menu_.pick(now_)) take_entry(*picked);
}

/// What is not the comparison's own is for the program.
void Comparison::take_entry(char key) {
  if (!press(key)) view_.asked_key = key;
  // What is a sign's is told when it happens.
  const auto entry = std::ranges::find(menu_entries, key, &MenuEntry::key);
  const bool told = std::ranges::find(sign_keys, key, &SignKey::key) != sign_keys.end();
  if (!told && entry != menu_entries.end()) tell(entry->words);
}

void Comparison::fill_menu_entries() {
  for (std::size_t i = 0; i < menu_entries.size(); ++i) {
    const char key = menu_entries[i].key;
    const bool of_mode = std::ranges::find(sign_keys, key, &SignKey::key) != sign_keys.end();
    const std::optional<Sign> sign = sign_of(key, mode_);
    menu_.set_entry(i, {sign ? words_of(*find_rule(mode_, *sign), {*sign, {}}) : menu_entries[i].words,
                        !of_mode || sign.has_value()});
  }
}

void Comparison::update_menu(Duration step) {
  fill_menu_entries();
  std::optional<Vec3> tip;
  if (hands_[menu_hand_].visible())
    tip = hands_[menu_hand_].T_world_marker * place_of(carried_by(menu_hand_).points, StickPoint::start);
  if (const std::optional<char> picked = menu_.update(tip, T_world_camera_.translation, step, now_))
    take_entry(*picked);
  view_.menu = menu_.view();
}

}  // namespace onestroke
