#pragma once

#include "core/head_tracker.h"

#include <array>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace onestroke {

/// What a hand does with a controller of Monado's remote headset, which is an Index, or without it.
struct ScriptedHand {
  bool trigger = false, b = false;
  float curl = 0;  ///< Of all fingers: 0 is an open hand, 1 a fist.
};

/// Moves the head of Monado's remote headset, which this machine's port 4242 moves, and remembers when it was told
/// what.
class ScriptedHead final : public HeadTracker {
 public:
  /// T_stage_head, vision axes and mm, so many seconds after move().
  using Path = std::function<Pose(double seconds)>;

  /// Holds the head still where the path begins. Throws Error where nobody listens.
  explicit ScriptedHead(Path path);
  ~ScriptedHead() override;
  ScriptedHead(const ScriptedHead&) = delete;

  void move();
  /// From now on; the hands are not there before.
  void use_hands(const ScriptedHand& left, const ScriptedHand& right);
  /// Where the world is that head_at() speaks of.
  void set_world(const Pose& T_world_stage);
  Pose begins_at() const { return path_(0); }

  /// The pose that the runtime had been told last.
  std::optional<Pose> head_at(Time time) const override;
  /// False where the machine was too busy, shortly before a time or after it, to tell the runtime as often as planned:
  /// what it knew then is not known.
  bool on_time(Time time) const;

 private:
  struct Sent {
    Time time;
    Pose T_stage_head;
  };

  void send(const std::stop_token& stop);

  const Path path_;
  int socket_ = -1;
  mutable std::mutex mutex_;  // over all below
  std::vector<Sent> sent_;
  std::optional<Time> moving_since_;
  std::optional<std::array<ScriptedHand, 2>> hands_;
  Pose T_world_stage_;
  std::jthread sender_;
};

}  // namespace onestroke
