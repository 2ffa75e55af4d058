#include "scene/hands.h"

#include <utility>

namespace onestroke {

namespace {

double image_x(const MarkerObservation& m) {
  return m.T_camera_marker.translation.x / m.T_camera_marker.translation.z;
}

bool usable(const MarkerObservation& m) {
  return m.state != MarkerState::lost && m.T_camera_marker.translation.z > 0;
}

void look(HeldMarker& held, const MarkerObservation& m, const Pose& T_world_camera, Time now) {
  if (m.state == MarkerState::measured || !held.held) held.measured = now;
  held.held = true;
  held.id = m.id;
  held.name = m.name;
  held.state = m.state;
  held.T_world_marker = T_world_camera * m.T_camera_marker;
  held.image_x = image_x(m);
  held.seen = now;
}

}  // namespace

bool Hands::update(const FrameRecord& record, Time now) {
  follow_held(record, now);
  take_up_new(record, now);
  return exchange_when_crossed(now);
}

void Hands::follow_held(const FrameRecord& record, Time now) {
  for (HeldMarker& held : held_) {
    if (!held.held) continue;
    held.state = MarkerState::lost;
    for (const MarkerObservation& m : record.seen())
      if (m.id == held.id && usable(m)) look(held, m, record.T_world_camera, now);
    if (held.state == MarkerState::lost && now - held.seen > forgotten_after) held = {};
  }
}

// The nearest sticks that no hand holds, each to the free hand on its side.
void Hands::take_up_new(const FrameRecord& record, Time now) {
  for (int round = 0; round < 2; ++round) {
    const bool left_free = !held_[0].held, right_free = !held_[1].held;
    if (left_free && right_free) exchanged_ = false;
    if (!left_free && !right_free) return;
    const MarkerObservation* nearest = nullptr;
    for (const MarkerObservation& m : record.seen()) {
      const bool taken = (!left_free && held_[0].id == m.id) || (!right_free && held_[1].id == m.id);
      if (!usable(m) || taken) continue;
      if (!nearest || m.T_camera_marker.translation.z < nearest->T_camera_marker.translation.z) nearest = &m;
    }
    if (!nearest) return;
    Hand hand = left_free ? Hand::left : Hand::right;
    if (left_free && right_free && image_x(*nearest) > 0) hand = Hand::right;
    look(at(hand), *nearest, record.T_world_camera, now);
    // Two that come together are told apart by each other, not by the middle of the picture.
    const bool came_together = round == 1;
    if (came_together && held_[0].image_x > held_[1].image_x) std::swap(held_[0], held_[1]);
  }
}

bool Hands::exchange_when_crossed(Time now) {
  const double past = exchanged_ ? held_[1].image_x - held_[0].image_x : held_[0].image_x - held_[1].image_x;
  const bool wrong_way = held_[0].visible() && held_[1].visible() && past > crossed;
  if (!wrong_way) {
    crossing_ = false;
    return false;
  }
  if (!crossing_) crossing_since_ = now;
  crossing_ = true;
  if (now - crossing_since_ < crossed_for) return false;
  crossing_ = false;
  std::swap(held_[0], held_[1]);
  return true;
}

bool Hands::exchange() {
  if (!held_[0].held || !held_[1].held) return false;
  std::swap(held_[0], held_[1]);
  exchanged_ = !exchanged_;
  crossing_ = false;
  return true;
}

}  // namespace onestroke
