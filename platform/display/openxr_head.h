#pragma once

#include "core/pose_history.h"
#include "core/spsc_queue.h"
#include "display/openxr_clock.h"

#include <mutex>
#include <optional>

namespace onestroke {

/// Where the head was of late. The thread that renders attaches, samples and detaches; at() is any thread's.
class OpenXrHead {
 public:
  OpenXrHead();

  /// Before the first sample, and after detach(). Clock, session and world outlive detach(). Throws OpenXrError.
  void attach(const OpenXrClock& clock, XrSession session, XrSpace world);
  /// What is known is forgotten. Waits for who is asking.
  void detach();

  /// Once a frame: remembers where the head is now, where the runtime knows. No lock, no allocation. Throws
  /// OpenXrError.
  void sample(Time now);
  /// The world has moved: what was remembered holds no more.
  void forget();

  /// T_world_head. For what the runtime must still remember it is asked; for times before, what was sampled tells.
  std::optional<Pose> at(Time time) const;

 private:
  struct Sample {
    Time time;
    Pose pose;
    std::optional<Velocity> velocity;
  };
  struct Source {
    const OpenXrClock& clock;
    OpenXrOwned<XrSpace, xrDestroySpace> head;
    XrSpace world;

    Source(const OpenXrClock& runtime_clock, XrSpace view, XrSpace around)
        : clock(runtime_clock), head(view), world(around) {}
  };

  std::optional<Sample> locate(Time time) const;

  std::optional<Source> source_;  // written under the lock, read under it but by the thread that writes it
  mutable SpscQueue<Sample> samples_;
  mutable std::mutex asking_;  // over all below, and the queue's other end
  mutable PoseHistory history_;
};

}  // namespace onestroke
