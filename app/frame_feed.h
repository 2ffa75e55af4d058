#pragma once

#include "app/command_line.h"
#include "core/tracked_frame.h"
#include "tracking/tracking_thread.h"

#include <memory>

namespace onestroke {

/// The poses of a record, carried on to a picture by their velocities, 100 ms at most.
void predict_record(const FrameRecord& from, const Picture& to, FrameRecord& predicted);

/// Decides which picture a frame shows, and which poses belong to it. One thread; allocates nothing after the
/// constructor.
class FrameFeed {
 public:
  enum class Pace {
    newest,       ///< a device: the newest picture
    at_its_time,  ///< a recording on a screen: each picture when its time has come
    each,         ///< a recording into files: one picture a frame, waited for
  };

  /// `fresh` has an effect at the pace `newest` alone: elsewhere every picture is tracked before it is shown.
  FrameFeed(TrackingThread& tracking, Pace pace, PictureTime mode);

  enum class Next { same, picture, end };
  /// The next frame, to be seen at `display_time`: shows the same picture again, or another one, or there will be none
  /// any more. `stop` ends the wait of pace `each`.
  Next advance(Time display_time, bool (*stop)());

  /// Of the last Next::picture; empty once it has been taken.
  PictureHandle take_picture() { return std::move(picture_); }
  const FrameRecord& record() const { return *shown_; }
  /// The time that the frame shows, in the record's time; does not go back.
  Time now() const { return now_; }
  /// A pause: a recording goes on as if no time had passed.
  void hold() { held_ = true; }

 private:
  Next advance_newest();
  Next advance_at_its_time(Time display_time);
  Next advance_each(bool (*stop)());
  bool take_pending();
  Next show_pending();

  TrackingThread& tracking_;
  const Pace pace_;
  const bool fresh_;
  PictureHandle picture_, pending_picture_, newest_;
  std::unique_ptr<FrameRecord> tracked_, pending_, predicted_;
  const FrameRecord* shown_;
  bool pending_any_ = false, any_shown_ = false, held_ = true;
  Time began_display_, began_record_;  // The same moment on both clocks.
  Time now_, shown_since_;
};

}  // namespace onestroke
