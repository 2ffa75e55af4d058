#include "scene/comparison.h"

#include "scene/comparison_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace onestroke {

namespace {

constexpr double degrees = 180 / std::numbers::pi;
// Below this the axis of a turn is noise.
constexpr double no_turn = 0.5 / degrees;

}  // namespace

const ComparisonView& Comparison::update(const FrameRecord& record, Time now) {
  const Duration step = started_ ? now - last_ : Duration{};
  last_ = now;
  started_ = true;
  if (hands_.update(record, now)) {
    std::swap(motions_[0], motions_[1]);
    leader_ = other(leader_);
  }
  for (const Hand h : both_hands) follow_motion(h, step);
  const bool link_changed = choose_link(now);
  const bool leader_changed = choose_leader(now);
  for (const Hand h : both_hands) {
    if (link_changed || leader_changed) motion(h).rotation.go_over_to(followed(h), now);
    fill_hand(h, now);
  }
  view_.linked = linked_;
  view_.link_progress = gesture_.progress();
  fill_relative();
  print_hud(view_);
  return view_;
}

// A stick that comes anew, or comes back after it has faded, starts with no past.
void Comparison::follow_motion(Hand h, Duration step) {
  const HeldMarker& held = hands_[h];
  Motion& m = motion(h);
  if (!held.held || held.id != m.id) m = {};
  m.id = held.id;
  if (m.presence <= 0) {
    m.rotation.set(followed(h));
    m.turn.reset(own(h));
  }
  const double change = held.visible() ? step.seconds() / fade_in.seconds() : -step.seconds() / fade_out.seconds();
  m.presence = std::clamp(m.presence + change, 0.0, 1.0);
  m.turn.update(own(h), step);
}

bool Comparison::choose_link(Time now) {
  view_.both_visible = hands_[Hand::left].visible() && hands_[Hand::right].visible();
  std::optional<double> distance;
  if (view_.both_visible)
    distance = norm(hands_[Hand::left].T_world_marker.translation - hands_[Hand::right].T_world_marker.translation);
  const bool gestured = gesture_.update(distance, now);
  const bool change = gestured != std::exchange(toggle_asked_, false);
  linked_ = linked_ != change;
  return change;
}

bool Comparison::choose_leader(Time now) {
  const HeldMarker& leading = hands_[leader_];
  const HeldMarker& following = hands_[other(leader_)];
  if (!following.visible()) return false;
  const bool gone = !leading.held || (!leading.visible() && now - leading.seen > leader_missed);
  const double turn = motion(other(leader_)).turn.angle();
  const bool turned = turn > takes_lead && turn > clearly_more * motion(leader_).turn.angle();
  if (!gone && !turned) return false;
  leader_ = other(leader_);
  return linked_;
}

// The model turns about its own middle, which stays where its stick holds it.
void Comparison::fill_hand(Hand h, Time now) {
  const HeldMarker& held = hands_[h];
  HandView& v = view_.hands[static_cast<std::size_t>(h)];
  v.held = held.held;
  v.marker_id = held.id;
  v.state = held.state;
  v.opacity = held.held ? smooth_step(motion(h).presence) : 0;
  v.leads = linked_ && h == leader_;
  v.T_world_model.rotation = motion(h).rotation.update(followed(h), now);
  const CarriedModel* carried = carried_by(held.id);
  const Vec3 pivot = carried ? carried->pivot : Vec3{};
  v.T_world_model.translation = held.T_world_marker * pivot - rotate(v.T_world_model.rotation, pivot);
  v.label.clear();
  if (held.held) print_label(held, carried ? carried->words.view() : std::string_view(), now, v.label);
}

const CarriedModel* Comparison::carried_by(int marker_id) const {
  const auto found = std::ranges::find(carried_, marker_id, &CarriedModel::marker_id);
  return found == carried_.end() ? nullptr : &*found;
}

void Comparison::fill_relative() {
  if (!view_.both_visible) return;
  const Pose& left = hands_[Hand::left].T_world_marker;
  const Pose& right = hands_[Hand::right].T_world_marker;
  const Quat turn = normalized(left.rotation.conjugate() * right.rotation);
  const Vec3 vector = log_so3(turn);
  RelativePose& r = view_.relative;
  r.angle_deg = norm(vector) * degrees;
  r.axis = norm(vector) > no_turn ? normalized(vector) : Vec3{};
  r.euler_deg = degrees * to_euler_xyz(turn);
  r.distance = norm(left.translation - right.translation);
  print_axis(r.axis, r.axis_words);
}

}  // namespace onestroke
