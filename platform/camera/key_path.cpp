#include "camera/key_path.h"

#include <algorithm>
#include <numbers>

namespace onestroke {
namespace {

Turn between(const Turn& a, const Turn& b, double u) {
  return {a.round + u * (b.round - a.round), a.tilt + u * (b.tilt - a.tilt), a.roll + u * (b.roll - a.roll)};
}

/// The last key that has begun by t, the first one where none has.
template <typename AnyKey>
std::size_t begun(std::span<const AnyKey> keys, double t) {
  const auto later = std::ranges::find_if(keys, [t](const AnyKey& key) { return key.arrives > t; });
  return later == keys.begin() ? 0 : static_cast<std::size_t>(later - keys.begin()) - 1;
}

/// How far on the way from a key to the next one.
template <typename AnyKey>
double way(std::span<const AnyKey> keys, std::size_t i, double t) {
  return i + 1 < keys.size() ? ease(t, keys[i].leaves, keys[i + 1].arrives) : 0;
}

}  // namespace

double ease(double t, double a, double b) {
  const double u = std::clamp((t - a) / (b - a), 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

Quat to_quat(const Turn& turn) {
  constexpr double radian = std::numbers::pi / 180;
  return exp_so3({0, 0, turn.roll * radian}) * exp_so3({turn.tilt * radian, 0, 0}) *
         exp_so3({0, turn.round * radian, 0});
}

KeyPath::KeyPath(const Rod& rod, std::span<const Key> keys, const KeyPath* left) : keys_(keys.begin(), keys.end()) {
  const std::vector<Vec3>& vertices = rod.spec().shape.vertices();
  places_ = {vertices.front(), vertices[vertices.size() / 2], vertices.back(), rod.centre()};
  for (Key& key : keys_) {
    if (key.on_left) key.at = left->at(key.arrives) * key.at;
    key.on_left = false;
  }
}

Pose KeyPath::placed(const Turn& turn, RodPlace place, Vec3 at) const {
  const Quat rotation = to_quat(turn);
  return {rotation, at - rotate(rotation, on_rod(place))};
}

Pose KeyPath::at(double t) const {
  const std::span<const Key> keys = keys_;
  const std::size_t i = begun(keys, t);
  const Key& here = keys[i];
  const double u = way(keys, i, t);
  const Pose from = placed(here.turn, here.place, here.at);
  if (u == 0) return from;
  const Key& next = keys[i + 1];
  const Vec3 start = from * on_rod(next.place);
  return placed(between(here.turn, next.turn, u), next.place, start + u * (next.at - start));
}

Pose orbit_at(const Orbit& orbit, double t) {
  if (orbit.keys.empty()) return {};
  const std::size_t i = begun(orbit.keys, t);
  const double u = way(orbit.keys, i, t);
  const Turn& here = orbit.keys[i].turn;
  const Quat rotation = to_quat(u == 0 ? here : between(here, orbit.keys[i + 1].turn, u));
  return {rotation, orbit.about - rotate(rotation, orbit.about)};
}

}  // namespace onestroke
