#pragma once

#include "core/pose_history.h"
#include "display/openxr_clock.h"

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

  /// Begins to follow the head. Clock, session and space outlive detach(). The space is the world's until place() says
  /// where it is. Throws OpenXrError.
  void attach(const OpenXrClock& clock, XrSession session, XrSpace space);
  /// Where the space is in the world from now on, also for what is remembered.
  void place(const Pose& T_world_space);
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
    XrSpace space;

    Source(const OpenXrClock& runtime_clock, XrSpace view, XrSpace around)
        : clock(runtime_clock), head(view), space(around) {}
  };

  void follow(const std::stop_token& stop) noexcept;
  void sample();

  std::optional<Source> source_;  // constant while the thread below lives
  mutable std::mutex asking_;     // over the history, which is in the space, and where that is
  PoseHistory history_;
  Pose T_world_space_;
  std::jthread follower_;
};

}  // namespace onestroke
