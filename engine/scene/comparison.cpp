#include "scene/comparison.h"

#include "scene/comparison_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace onestroke {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
// Below this the axis of a turn is noise.
constexpr double no_turn = 0.5 / degrees;
const CarriedModel nothing;

/// What hands that point into the menu do besides.
bool made_in_passing(Sign sign) {
  return sign != Sign::arms_crossed && sign != Sign::corners_parted && sign != Sign::stick_gone;
}

}  // namespace

Comparison::Comparison(std::span<const CarriedModel> carried, const ComparisonOptions& options)
    : carried_(carried), options_(options) {
  pointer_ = preferred();
  base_ = other(preferred());
}

void Comparison::set_fit(const std::optional<Similarity>& base_from_laid) {
  changed_ = changed_ || fit_.has_value() != base_from_laid.has_value();
  fit_ = base_from_laid;
}

bool Comparison::press(char key) {
  const bool known = key == 'x' || key == 'i' || key == next_entry || key == pick_entry ||
                     std::ranges::find(sign_keys, key, &SignKey::key) != sign_keys.end();
  if (known && key_count_ < keys_.size()) keys_[key_count_++] = key;
  return known;
}

const ComparisonView& Comparison::update(const FrameRecord& record, Time now) {
  const Duration step = frames_.step_to(now);
  T_world_camera_ = record.T_world_camera;
  now_ = now;
  view_.snapshot = false;
  view_.asked_key = 0;
  view_.event_count = 0;
  if (hands_.update(record, now)) exchange_hands();
  for (const Hand h : both_hands) {
    follow_motion(h, step);
    follow_card(h, step, now);
  }
  view_.both_visible = hands_[Hand::left].visible() && hands_[Hand::right].visible();
  press_keys();
  look_for_signs(now);
  update_menu(step);
  choose_leader(now);
  laid_.update(mode_.laid_over(), step);
  const Hand first = mode_.laid_over() ? base_ : other(pointer_);
  place(first, now);
  place(other(first), now);
  changed_ = false;
  cut(step);
  measure(step, now);
  for (const Hand h : both_hands) fill_hand(h, now);
  view_.mode = mode_;
  view_.pointer = pointer_;
  view_.base = base_;
  view_.laid = laid_.value();
  fill_offer();
  fill_relative();
  print_hud(view_);
  return view_;
}

void Comparison::exchange_hands() {
  std::swap(motions_[0], motions_[1]);
  signs_.exchange();
  leader_ = other(leader_);
  pointer_ = other(pointer_);
  base_ = other(base_);
  menu_hand_ = other(menu_hand_);
}

// A stick that comes anew, or comes back after it has faded, starts with no past. A model that is frozen stays without
// its stick.
void Comparison::follow_motion(Hand h, Duration step) {
  const HeldMarker& held = hands_[h];
  Motion& m = motion(h);
  // It makes way for another stick's.
  if (held.held && held.id != m.id && m.frozen && m.presence.value() > 0) {
    m.presence.update(false, step, fade_in, fade_out);
    return;
  }
  const bool stays = !held.held && m.frozen;
  if (!stays && (!held.held || held.id != m.id)) m = {};
  if (held.held) m.id = held.id;
  m.fresh = m.presence.value() <= 0;
  if (m.fresh) m.turn.reset(hands_[h].T_world_marker.rotation);
  // A model that is laid on another needs no stick to be seen.
  const bool laid = mode_.laid_over() && h != base_ && hands_[base_].visible();
  m.presence.update(held.visible() || m.frozen || laid, step, fade_in, fade_out);
  m.turn.update(held.T_world_marker.rotation, step);
}

void Comparison::follow_card(Hand h, Duration step, Time now) {
  Motion& m = motion(h);
  const HeldMarker& held = hands_[h];
  if (held.visible()) {
    const double distance = norm(held.T_world_marker.translation - T_world_camera_.translation);
    if (distance > card_beyond) m.near = false;
    if (distance > card_within)
      m.near_since.reset();
    else if (!m.near_since)
      m.near_since = now;
    m.near = m.near || (m.near_since && now - *m.near_since >= card_after);
  }
  // A stick that is a tool comes near for another reason.
  const bool near = m.near && mode_.tool == Tool::none;
  m.card.update((near || cards_) && (held.held || m.frozen), step);
}

void Comparison::press_keys() {
  for (const char key : std::span(keys_).first(std::exchange(key_count_, 0))) {
    if (key == 'i') cards_ = !cards_;
    if (key == next_entry || key == pick_entry) press_menu_key(key);
    if (key == 'x' && hands_.exchange()) exchange_hands();
    if (const std::optional<Sign> sign = sign_of(key, mode_)) apply({*sign, {}});
  }
}

void Comparison::look_for_signs(Time now) {
  StickPair pair;
  pair.both_visible = view_.both_visible;
  const auto there = [&](Hand h) { return hands_[h].held && now - hands_[h].seen < gone_after; };
  pair.both_held = there(Hand::left) && there(Hand::right);
  for (const Hand h : both_hands)
    for (std::size_t i = 0; i < pair.points[0].size(); ++i)
      pair.points[static_cast<std::size_t>(h)][i] = hands_[h].T_world_marker * carried_by(h).points[i];
  pair.right_to_left = right_to_left();
  const std::optional<MadeSign> made = signs_.update(pair, mode_, now);
  if (made && !(menu_.is_open() && made_in_passing(made->sign))) apply(*made);
}

Quat Comparison::right_to_left() const {
  return normalized(hands_[Hand::left].T_world_marker.rotation.conjugate() *
                    hands_[Hand::right].T_world_marker.rotation);
}

void Comparison::tell(std::string_view words) {
  if (view_.event_count < static_cast<int>(view_.events.size()))
    view_.events[static_cast<std::size_t>(view_.event_count++)] = words;
}

void Comparison::apply(const MadeSign& made) {
  const ModeRule* rule = find_rule(mode_, made.sign);
  if (!rule) return;
  const CompareMode before = std::exchange(mode_, after(mode_, *rule));
  changed_ = true;
  tell(words_of(*rule, made));
  if (rule->act == Act::snapshot) view_.snapshot = true;
  if (rule->act == Act::freeze) freeze(made);
  if (rule->act == Act::menu) toggle_menu();
  if (mode_.link == Link::mirrored && before.link != Link::mirrored)
    mirror_normal_ = rotate(T_world_camera_.rotation, {1, 0, 0});
  if (before.tool != Tool::none || mode_.tool == Tool::none) return;
  pointer_ = made.pointer.value_or(preferred());
  base_ = other(preferred());
  ruler_.begin(pointing_tip(), world_from_marker(other(pointer_)));
  // What stands between the eyes and the plane is cut away.
  const SectionPlane plane = plane_of_stick(hands_[pointer_].T_world_marker, false);
  plane_flipped_ = dot(plane.normal, T_world_camera_.translation) > plane.offset;
}

std::string_view Comparison::words_of(const ModeRule& rule, const MadeSign& made) const {
  if (rule.act == Act::freeze && motion(to_freeze(made)).frozen) return "Let go";
  if (rule.act == Act::menu && menu_.is_open()) return "Close the menu";
  return rule.words.empty() ? "End" : rule.words;
}

// By key there is no stick that points: what is frozen is let go, or else the model in the hand that holds is frozen.
Hand Comparison::to_freeze(const MadeSign& made) const {
  if (made.pointer) return other(*made.pointer);
  for (const Hand h : both_hands)
    if (motion(h).frozen) return h;
  return other(preferred());
}

void Comparison::freeze(const MadeSign& made) {
  Motion& m = motion(to_freeze(made));
  if (m.frozen)
    m.frozen.reset();
  else if (m.presence.value() > 0)
    m.frozen = m.place.shown();
}

std::optional<Hand> Comparison::set_leader() const {
  if (mode_.laid_over()) return base_;
  if (mode_.tool == Tool::section || mode_.tool == Tool::measure) return other(pointer_);
  return std::nullopt;
}

void Comparison::choose_leader(Time now) {
  const auto lead = [&](Hand h) {
    changed_ = changed_ || (linked() && h != leader_);
    leader_ = h;
  };
  if (const std::optional<Hand> set = set_leader()) {
    if (hands_[*set].held) lead(*set);
    return;
  }
  const HeldMarker& leading = hands_[leader_];
  const HeldMarker& following = hands_[other(leader_)];
  if (!following.visible()) return;
  const bool gone = !leading.held || (!leading.visible() && now - leading.seen > leader_missed);
  const double turn = motion(other(leader_)).turn.angle();
  const bool turned = turn > takes_lead && turn > clearly_more * motion(leader_).turn.angle();
  if (gone || turned) lead(other(leader_));
}

void Comparison::fill_hand(Hand h, Time now) {
  const HeldMarker& held = hands_[h];
  Motion& m = motion(h);
  HandView& v = seen(h);
  v.held = held.held;
  v.marker_id = m.id;
  v.state = held.state;
  v.world_from_marker = world_from_marker(h);
  v.opacity = held.held || m.frozen ? m.presence.value() : 0;
  v.shown = 1 - m.aside.value();
  v.card = m.card.value();
  v.leads = linked() && h == leader_;
  v.frozen = m.frozen.has_value();
  v.label.clear();
  if (held.held && held.id == m.id) print_label(held, carried_by(h).words.view(), v.frozen, now, v.label);
}

const CarriedModel& Comparison::carried_by(Hand h) const {
  const auto found = std::ranges::find(carried_, motion(h).id, &CarriedModel::marker_id);
  return found == carried_.end() ? nothing : *found;
}

void Comparison::fill_offer() {
  view_.offer.reset();
  if (!signs_.offer()) return;
  const OfferedSign& offered = *signs_.offer();
  if (menu_.is_open() && made_in_passing(offered.made.sign)) return;
  const ModeRule* rule = find_rule(mode_, offered.made.sign);
  if (!rule) return;
  view_.offer = OfferView{words_of(*rule, offered.made), offered.place_world, offered.progress};
}

void Comparison::fill_relative() {
  if (!view_.both_visible) return;
  const Pose& left = hands_[Hand::left].T_world_marker;
  const Pose& right = hands_[Hand::right].T_world_marker;
  const Quat turn = right_to_left();
  const Vec3 vector = log_so3(turn);
  RelativePose& r = view_.relative;
  r.angle_deg = norm(vector) * degrees;
  r.axis = norm(vector) > no_turn ? normalized(vector) : Vec3{};
  r.euler_deg = degrees * to_euler_xyz(turn);
  r.distance = norm(left.translation - right.translation);
  print_axis(r.axis, r.axis_words);
}

}  // namespace onestroke
