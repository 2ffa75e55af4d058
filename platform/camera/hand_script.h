#pragma once

#include "camera/key_path.h"
#include "camera/mode_scripts.h"
#include "camera/rod.h"
#include "camera/synthetic_options.h"
#include "camera/synthetic_renderer.h"

#include <span>
#include <vector>

namespace onestroke {

/// Slow swings, all of which come round within a period.
struct Swing {
  double period = 0;  ///< Seconds.

  /// From -1 to 1, `turns` times in 24 s or as near to that as comes round.
  double operator()(double t, int turns, double phase) const;
};

/// Whether a script shows two sticks.
bool shows_two_hands(ScriptKind kind);

/// Who is where at any time: the head, the sticks, the fingers. World axes: the head's camera at rest. Times in seconds
/// from 0; poses are smooth in time. Constant; any thread.
class HandScript {
 public:
  static constexpr std::size_t capsules_per_hand = 3;

  /// Two rods for a script of two hands, one for the others; they must outlive the script.
  HandScript(const SyntheticOptions& options, std::vector<const Rod*> rods);

  /// Seconds after which two hands do all again.
  double period() const { return swing_.period; }
  std::size_t hands() const { return rods_.size(); }
  const Rod& rod(std::size_t hand) const { return *rods_[hand]; }
  Pose T_world_camera(double t) const;
  /// How far the head turns to either side besides its sway, rad.
  double head_turn() const;
  Pose T_world_marker(std::size_t hand, double t) const;
  /// The capsules of a hand: thumb, forefinger, palm, as far as the options ask for fingers.
  std::size_t capsules() const { return fingers_ == 0 ? 0 : static_cast<std::size_t>(fingers_) + 1; }
  Pose T_world_capsule(std::size_t hand, std::size_t capsule, double t) const;
  /// Its size; the pose is left alone.
  void size_capsule(std::size_t capsule, SyntheticFinger& finger) const;

 private:
  double wrapped(double t) const;
  Pose held(std::size_t hand, double t) const;
  Pose shown(std::size_t hand, double t) const;
  Pose turned(double t) const;

  ScriptKind kind_;
  const ModeScript* mode_;
  Swing swing_;
  double distance_, rate_;
  int fingers_;
  bool head_moves_;
  std::vector<const Rod*> rods_;
  std::vector<Vec3> centres_;
  std::vector<KeyPath> paths_;  // of a script that shows a mode, a hand each
};

}  // namespace onestroke
