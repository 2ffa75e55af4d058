#pragma once

#include "camera/rod.h"

#include <array>
#include <span>
#include <vector>

namespace onestroke {

/// 0 before a, 1 after b, with no jump in speed or acceleration.
double ease(double t, double a, double b);

/// How a stick is turned, degrees: first round its own start arm, as on a turntable, then tilted, the start tip towards
/// the eyes, then rolled clockwise as they see it. At zero the start arm points up and the stop arm to the right.
struct Turn {
  double round = 0, tilt = 0, roll = 0;

  friend bool operator==(const Turn&, const Turn&) = default;
};
Quat to_quat(const Turn& turn);

/// The place of a stick that a key says where to bring; the middle is that of the rod's extent.
enum class RodPlace { start, corner, end, middle };

/// Where a stick is from one time to another, seconds: that place of it at `at`, mm, in world axes or, where
/// `on_left`, in the marker frame of the left stick as it is when the key begins.
struct Key {
  double arrives = 0, leaves = 0;
  RodPlace place = RodPlace::middle;
  Vec3 at;
  Turn turn;
  bool on_left = false;
};

/// A stick that rests at its keys and moves from each to the next with the least jerk; the place that the next key
/// names goes straight. Constant; any thread.
class KeyPath {
 public:
  /// Keys in order of time, at least one. `left`: where the left stick goes, for keys that are on it.
  KeyPath(const Rod& rod, std::span<const Key> keys, const KeyPath* left = nullptr);

  /// T_world_marker; before the first key and after the last one it rests there.
  Pose at(double t) const;

 private:
  Vec3 on_rod(RodPlace place) const { return places_[static_cast<std::size_t>(place)]; }
  Pose placed(const Turn& turn, RodPlace place, Vec3 at) const;

  std::array<Vec3, 4> places_;  // marker frame, by RodPlace
  std::vector<Key> keys_;       // all in world axes
};

/// Something turned about a point for a while.
struct OrbitKey {
  double arrives = 0, leaves = 0;
  Turn turn;
};
struct Orbit {
  Vec3 about;  ///< World axes, mm.
  std::span<const OrbitKey> keys;
};
/// What takes a point from where it was, unturned, to where it is at t; nothing without keys.
Pose orbit_at(const Orbit& orbit, double t);

}  // namespace onestroke
