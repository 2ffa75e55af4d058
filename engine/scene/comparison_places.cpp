// Where the models of a comparison are shown, cut and measured.
#include "scene/comparison.h"

namespace onestroke {

namespace {

// Between two models that are shown beside each other, mm.
constexpr double gap = 12;
// A tip this far from a model may still be meant for its surface, mm.
constexpr double near_model = 15;
constexpr double millimetres_per_metre = 1000;

/// As a mirror shows it that stands across `normal` in the world and across x in the marker: two reflections, hence a
/// rotation again, made of half turns about both axes.
Quat mirrored(Quat q, Vec3 normal) {
  return normalized(Quat{0, normal.x, normal.y, normal.z} * q * Quat{0, 1, 0, 0});
}

}  // namespace

Quat Comparison::followed(Hand h) const {
  if (!linked() || h == leader_) return hands_[h].T_world_marker.rotation;
  const Quat leading = hands_[leader_].T_world_marker.rotation;
  return mode_.link == Link::mirrored ? mirrored(leading, mirror_normal_) : leading;
}

// The model turns about its own middle, which stays where its stick holds it.
Vec3 Comparison::held_middle(Hand h) const {
  return hands_[h].T_world_marker * carried_by(h).pivot;
}

ModelPlace Comparison::target(Hand h) const {
  const Hand beside = other(h);
  const bool both = motion(beside).presence.value() > 0;
  if (mode_.laid_over() && h != base_ && both) {
    const Similarity laid = world_from_marker(base_) * base_from_laid();
    return {laid.rotation, laid * carried_by(h).pivot, laid.scale};
  }
  if (motion(h).frozen) return *motion(h).frozen;
  // A linked model whose stick cuts stands beside the one that is cut, and is cut alike.
  if (mode_.tool == Tool::section && linked() && h == pointer_ && both) {
    const double apart = carried_by(h).reach + carried_by(beside).reach + gap;
    const Vec3 aside = rotate(T_world_camera_.rotation, {h == Hand::right ? apart : -apart, 0, 0});
    return {followed(h), motion(beside).place.shown().middle + aside, 1};
  }
  return {followed(h), held_middle(h), 1};
}

Similarity Comparison::world_from_marker(Hand h) const {
  const ModelPlace& shown = motion(h).place.shown();
  return {shown.rotation, shown.middle - shown.scale * rotate(shown.rotation, carried_by(h).pivot), shown.scale};
}

// Between marker frames. What carries no model is laid marker on marker.
Similarity Comparison::base_from_laid() const {
  const CarriedModel& base = carried_by(base_);
  const CarriedModel& laid = carried_by(other(base_));
  if (base.reach <= 0 || laid.reach <= 0) return {};
  const Similarity aligned = mode_.tool == Tool::fitted && fit_ ? *fit_ : Similarity{};
  return base.marker_from_model * aligned * inverse(laid.marker_from_model);
}

void Comparison::place(Hand h, Time now) {
  Motion& m = motion(h);
  const ModelPlace where = target(h);
  if (m.fresh)
    m.place.set(where);
  else if (changed_)
    m.place.go_over_to(where, now);
  m.place.update(where, now);
}

Vec3 Comparison::pointing_tip() const {
  return hands_[pointer_].T_world_marker * carried_by(pointer_).points[static_cast<std::size_t>(StickPoint::start)];
}

// A plane that was turned round would cut away what is to be seen: the cut is healed and made again from the other
// side.
void Comparison::turn_plane() {
  if (!hands_[pointer_].visible()) return;
  plane_ = plane_of_stick(hands_[pointer_].T_world_marker, plane_flipped_);
  const Vec3 to_eye = T_world_camera_.translation - hands_[pointer_].T_world_marker.translation;
  const double kept = dot(plane_.normal, normalized(to_eye));  // above zero: the eye is on the side that is kept
  plane_turns_ = mode_.tool == Tool::section && (plane_turns_ ? kept > 0 : kept > turns_over);
  if (!plane_turns_ || cutting_.value() > 0) return;
  plane_flipped_ = !plane_flipped_;
  plane_turns_ = false;
  plane_ = plane_of_stick(hands_[pointer_].T_world_marker, plane_flipped_);
}

void Comparison::cut(Duration step) {
  const Hand touched = other(pointer_);
  const bool cuts = mode_.tool == Tool::section;
  turn_plane();
  cutting_.update(cuts && !plane_turns_, step);
  for (const Hand h : both_hands) {
    seen(h).cut.reset();
    motion(h).aside.update(h == pointer_ && (cuts ? !linked() : mode_.tool == Tool::measure), step);
  }
  if (cutting_.value() <= 0) return;
  const auto eased = [&](Hand h, const SectionPlane& plane) {
    const ModelPlace& shown = motion(h).place.shown();
    return eased_in(plane, shown.middle, shown.scale * carried_by(h).reach, cutting_.value());
  };
  seen(touched).cut = eased(touched, plane_);
  if (!linked()) return;
  // Through the same place of the other model, by both models' own frames.
  const Similarity own_frames = carried_by(pointer_).marker_from_model * inverse(carried_by(touched).marker_from_model);
  const Similarity across = world_from_marker(pointer_) * own_frames * inverse(world_from_marker(touched));
  seen(pointer_).cut = eased(pointer_, moved(across, plane_));
}

void Comparison::measure(Duration step, Time now) {
  const Hand measured = other(pointer_);
  measuring_.update(mode_.tool == Tool::measure, step);
  if (mode_.tool == Tool::measure) {
    const CarriedModel& model = carried_by(measured);
    const ModelPlace& shown = motion(measured).place.shown();
    const Vec3 tip = pointing_tip();
    const bool near = norm(tip - shown.middle) < shown.scale * model.reach + near_model;
    const bool makes_sign = signs_.offer() && signs_.offer()->progress > 0;
    const bool picks = near && !makes_sign && !menu_.is_open() && hands_[pointer_].visible();
    ruler_.update(picks ? std::optional(tip) : std::nullopt, world_from_marker(measured),
                  model.reach > 0 ? model.marker_from_model.scale / millimetres_per_metre : 1, now);
  }
  view_.measure = ruler_.view();
  view_.measure.amount = measuring_.value();
}

}  // namespace onestroke
