#pragma once

#include "core/inline_vector.h"
#include "core/time.h"
#include "display/openxr_instance.h"
#include "display/openxr_refresh_rate.h"
#include "render/device.h"

#include <limits>
#include <span>
#include <utility>

namespace onestroke {

/// The program's turn at the headset, from state to state as the runtime leads it.
class OpenXrSession {
 public:
  /// Instance and device outlive this; the device was made through OpenXrVulkan. Throws OpenXrError.
  OpenXrSession(const OpenXrInstance& instance, const Device& device, XrEnvironmentBlendMode blend_mode);

  XrSession handle() const { return *session_; }
  /// What each eye's image should measure, pixels.
  VkExtent2D view_size() const { return view_size_; }

  /// Takes what the runtime has to say, begins and ends the turn as it asks. Throws OpenXrError.
  void take_events();
  /// True from READY to STOPPING: frames are to be begun and ended, whether seen or not.
  bool running() const { return running_; }
  /// True once the runtime wants no more of this session, be it that the program or the wearer asked to leave.
  bool over() const { return over_; }
  /// Which spaces the wearer, or the runtime, moves (a recentring), as heard since the last call.
  using SpaceChanges = InlineVector<XrEventDataReferenceSpaceChangePending, 8>;
  SpaceChanges take_space_changes() { return std::exchange(space_changes_, {}); }
  /// True where the runtime is about to go, or to take the session back.
  bool loss_pending() const { return loss_pending_; }

  /// Waits until the runtime wants the next frame, and begins it. Throws OpenXrError.
  XrFrameState begin_frame();
  /// Of the frame that was begun last, as the runtime expects it to be seen.
  XrTime display_time() const { return display_time_; }
  /// True between begin_frame() and end_frame().
  bool frame_begun() const { return frame_begun_; }
  /// Ends the frame that was begun, with its layers, the lowest first; none where nothing was drawn. Throws
  /// OpenXrError.
  void end_frame(std::span<const XrCompositionLayerBaseHeader* const> layers);

  /// Asks the runtime to end the session, and sees it through its last states, for as long as a runtime may take.
  /// Throws OpenXrError.
  void leave();

  struct Count {
    std::int64_t frames = 0;  ///< Begun.
    std::int64_t seen = 0;    ///< Ended with something drawn.
    std::int64_t missed = 0;  ///< Display periods between frames for which there was none.
    std::int64_t slow = 0;    ///< Frames for which this program needed more than a period, from begun to ended.

    Count& operator+=(const Count& more) {
      frames += more.frames;
      seen += more.seen;
      missed += more.missed;
      slow += more.slow;
      return *this;
    }
  };
  const Count& count() const { return count_; }

 private:
  void go_to(XrSessionState state);
  void count_missed(const XrFrameState& frame);
  /// The screen's own, as far as it is known.
  XrDuration period() const { return refresh_rate_.period().value_or(shortest_period_); }

  const OpenXrInstance& instance_;
  VkExtent2D view_size_;
  XrEnvironmentBlendMode blend_mode_;
  OpenXrOwned<XrSession, xrDestroySession> session_;
  OpenXrRefreshRate refresh_rate_;
  bool running_ = false, over_ = false, loss_pending_ = false, frame_begun_ = false;
  SpaceChanges space_changes_;
  XrTime display_time_ = 0;
  Time begun_;
  XrDuration shortest_period_ = std::numeric_limits<XrDuration>::max();
  Count count_;
};

}  // namespace onestroke
