#include "camera/hand_script.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

constexpr double pi = std::numbers::pi;

/// Seconds, of the script of two hands that show no mode; what the head's sway is written for.
constexpr double usual_period = 24;

double side_of(std::size_t hand) {
  return hand == 0 ? -1 : 1;
}

/// Where the middle of a stick is, before its sway.
Vec3 place(std::size_t hand, double t) {
  constexpr double beside = 75, away = 255, closer = 25, pass = 70, usual = 445;
  const double swap = pi * (ease(t, 14.4, 16.8) + ease(t, 20.0, 22.2));
  const double meet = ease(t, 16.8, 18.2) - ease(t, 18.8, 20.0);
  const double apart = beside + away * (1 - ease(t, 0, 3) + ease(t, 22.2, 24)) - closer * meet;
  const double near = ease(t, 3, 5) - ease(t, 5.2, 7.2), far = ease(t, 6.9, 8.9) - ease(t, 10.2, 12.2);
  const double side = side_of(hand);
  return {side * apart * std::cos(swap), 0, usual - 55 * near + 90 * far + side * pass * std::sin(swap)};
}

Vec3 sway(const Swing& swing, std::size_t hand, double t) {
  const double p = 1.7 * static_cast<double>(hand);
  return {3.0 * swing(t, 5, p) + 1.0 * swing(t, 17, 2 * p), 5.0 * swing(t, 4, p + 1) + 1.2 * swing(t, 13, p),
          5.0 * swing(t, 3, p + 2)};
}

/// What a hand that means to be still does: it drifts, and trembles by half a millimetre.
Vec3 tremor(const Swing& swing, std::size_t hand, double t) {
  const double p = 1.7 * static_cast<double>(hand);
  return {0.6 * swing(t, 7, p) + 0.3 * swing(t, 43, 2 * p) + 0.1 * swing(t, 170, p),
          0.7 * swing(t, 6, p + 1) + 0.3 * swing(t, 47, p) + 0.1 * swing(t, 190, p), 0.6 * swing(t, 5, p + 2)};
}

Quat lean(const Swing& swing, std::size_t hand, double t) {
  const double p = 2.3 * static_cast<double>(hand);
  const Quat rest = hand == 0 ? from_euler_xyz(0.20, 0.32, 0.10) : from_euler_xyz(0.15, pi - 0.35, -0.12);
  return exp_so3({0.05 * swing(t, 5, p), 0.06 * swing(t, 4, p + 1), 0.05 * swing(t, 7, p + 2)}) * rest;
}

/// A full turn about x, then about y, then about z; the second hand follows a little later.
Quat turn(std::size_t hand, double t) {
  const double late = 0.35 * static_cast<double>(hand);
  const auto angle = [&](double from) { return 2 * pi * ease(t - late, from, from + 3.3); };
  return from_euler_xyz(angle(3.1), angle(6.9), angle(10.7));
}

Quat from_axes(Vec3 x, Vec3 y, Vec3 z) {
  return to_quat({{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}});
}

}  // namespace

double Swing::operator()(double t, int turns, double phase) const {
  return std::sin(2 * pi * std::max(1.0, std::round(turns * period / usual_period)) * t / period + phase);
}

bool shows_two_hands(ScriptKind kind) {
  return kind == ScriptKind::hands || find_mode_script(kind);
}

HandScript::HandScript(const SyntheticOptions& options, std::vector<const Rod*> rods)
    : kind_(options.script),
      mode_(find_mode_script(options.script)),
      swing_{mode_ ? mode_->period : usual_period},
      distance_(options.distance),
      rate_(options.step_deg * pi / 180 * options.fps),
      fingers_(options.fingers),
      head_moves_(options.head.value_or(shows_two_hands(options.script))),
      rods_(std::move(rods)) {
  for (const Rod* rod : rods_) centres_.push_back(rod->centre());
  if (!mode_) return;
  paths_.reserve(2);
  paths_.emplace_back(*rods_[0], mode_->left);
  paths_.emplace_back(*rods_[1], mode_->right, &paths_[0]);
}

double HandScript::wrapped(double t) const {
  return t - period() * std::floor(t / period());
}

Pose HandScript::T_world_camera(double t) const {
  if (!head_moves_) return {};
  const Pose sways{exp_so3({0.016 * swing_(t, 4, 0.4), 0.030 * swing_(t, 3, 1.1), 0.012 * swing_(t, 5, 2)}),
                   {9 * swing_(t, 3, 1), 5 * swing_(t, 5, 0), 6 * swing_(t, 2, 2)}};
  return mode_ ? orbit_at(mode_->head, wrapped(t)) * sways : sways;
}

double HandScript::head_turn() const {
  double most = 0;
  if (!head_moves_ || !mode_) return most;
  for (const OrbitKey& key : mode_->head.keys) most = std::max(most, std::abs(key.turn.round) * pi / 180);
  return most;
}

Pose HandScript::T_world_marker(std::size_t hand, double t) const {
  if (mode_) return shown(hand, wrapped(t));
  return kind_ == ScriptKind::hands ? held(hand, wrapped(t)) : turned(t);
}

Pose HandScript::shown(std::size_t hand, double t) const {
  const Pose still = orbit_at(mode_->both, t) * paths_[hand].at(t);
  const double p = 2.3 * static_cast<double>(hand);
  const Quat leans = exp_so3({0.006 * swing_(t, 5, p), 0.006 * swing_(t, 4, p + 1), 0.006 * swing_(t, 7, p + 2)});
  const Quat rotation = normalized(leans * still.rotation);
  const Vec3 centre = still * centres_[hand] + tremor(swing_, hand, t);
  return {rotation, centre - rotate(rotation, centres_[hand])};
}

Pose HandScript::held(std::size_t hand, double t) const {
  const Quat rotation = normalized(turn(hand, t) * lean(swing_, hand, t));
  return {rotation, place(hand, t) + sway(swing_, hand, t) - rotate(rotation, centres_[hand])};
}

Pose HandScript::turned(double t) const {
  const double angle = rate_ * t;
  Vec3 axis;
  if (kind_ == ScriptKind::turn_x) axis = {1, 0, 0};
  if (kind_ == ScriptKind::turn_y) axis = {0, 1, 0};
  if (kind_ == ScriptKind::turn_z) axis = {0, 0, 1};
  const Quat rotation = exp_so3(std::remainder(angle, 2 * pi) * axis);
  return {rotation, Vec3{0, 0, distance_} - rotate(rotation, centres_[0])};
}

Pose HandScript::T_world_capsule(std::size_t hand, std::size_t capsule, double t) const {
  const double side = hands() == 1 ? 1 : side_of(hand);
  const Shape& shape = rods_[hand]->spec().shape;
  const Pose stick = T_world_marker(hand, t);
  const double slide = mode_ ? 0 : 0.12 * swing_(t, 2, 0.8 + 2 * static_cast<double>(hand));
  const double grip = 0.78 + slide;
  const CentrelinePoint held_at = shape.at(grip * shape.length());
  const Vec3 point = stick * held_at.position, along = rotate(stick.rotation, held_at.tangent);
  // The thumb lies on the side of the stick that faces the head, the forefinger behind it. Where the stick points at
  // the head neither side exists; there the offset shrinks to nothing and grows again.
  const Vec3 to_head = normalized(-point);
  const Vec3 raw = to_head - dot(to_head, along) * along;
  const Vec3 aside = (1 / std::max(norm(raw), 0.35)) * raw;

  const bool behind = capsule == 1, palm = capsule + 1 == capsules();
  const Vec3 back = normalized(behind && !palm ? Vec3{0.75 * side, 0.62, -0.22} : Vec3{0.42 * side, 0.85, -0.30});
  SyntheticFinger thumb;
  size_capsule(0, thumb);
  const double off = thumb.radius + shape.radius() - 1;
  Vec3 origin = point + (behind && !palm ? -off : off) * aside - (behind && !palm ? 12.0 : 5.0) * back;
  Vec3 direction = back;
  if (palm) {
    origin = origin + (thumb.length - 4) * back + Vec3{2 * side, 4, -6};
    direction = normalized(Vec3{0.30 * side, 0.95, -0.10});
  }
  const Vec3 away = behind && !palm ? Vec3{0, 0, -1} : Vec3{0, 0, 1};
  const Vec3 z = normalized(away - dot(away, direction) * direction);
  return {from_axes(cross(direction, z), direction, z), origin};
}

void HandScript::size_capsule(std::size_t capsule, SyntheticFinger& finger) const {
  const bool palm = capsule != 0 && capsule + 1 == capsules();
  finger.length = palm ? 190 : capsule == 0 ? 46 : 62;
  finger.radius = palm ? 17 : capsule == 0 ? 8.5 : 7.5;
  finger.jointed = !palm;
}

}  // namespace onestroke
