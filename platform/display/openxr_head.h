#pragma once

#include "core/pose_history.h"
#include "display/openxr_clock.h"
#include "display/openxr_spaces.h"

#include <mutex>
#include <optional>
#include <thread>

namespace onestroke {

/// Where the head was of late, by a history that a thread of its own fills: not every runtime remembers, and frames may
/// be few. The thread that renders attaches and detaches; at() is any thread's.
class OpenXrHead {
 public:
  OpenXrHead();
  ~OpenXrHead() { detach(); }

  /// Begins to follow the head. Clock and session, and the place's space, outlive detach(). Throws OpenXrError.
  void attach(const OpenXrClock& clock, XrSession session, const OpenXrPlace& place);
  /// Another place to ask in; what is remembered still holds.
  void use(const OpenXrPlace& place);
  /// The world is another one from now on, also for what is remembered, and so is the place to ask in.
  void move(const Pose& T_new_old, const OpenXrPlace& place);
  /// Ends that, and forgets.
  void detach();
  /// The world has moved: what was remembered holds no more.
  void forget();

  /// T_world_head; none where it is not known.
  std::optional<Pose> at(Time time) const;

 private:
  struct Source {
    const OpenXrClock& clock;
    OpenXrOwned<XrSpace, xrDestroySpace> head;

    Source(const OpenXrClock& runtime_clock, XrSpace view) : clock(runtime_clock), head(view) {}
  };

  void follow(const std::stop_token& stop) noexcept;
  void sample();

  std::optional<Source> source_;  // constant while the thread below lives
  mutable std::mutex asking_;     // over all below
  OpenXrPlace place_;
  PoseHistory history_;  // in the world as it was at first
  Pose T_world_first_;
  int moves_ = 0;
  std::jthread follower_;
};

}  // namespace onestroke
