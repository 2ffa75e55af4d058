#pragma once

#include "app/command_line.h"
#include "app/feed.h"
#include "core/tracked_frame.h"
#include "tracking/tracking_thread.h"

#include <memory>
#include <optional>

namespace onestroke {

/// The poses of a record, carried on to a time by their velocities, 100 ms at most; seen from where the record's camera
/// was.
void predict_record(const FrameRecord& from, Time to, FrameRecord& predicted);
/// As above to a picture, and seen from where its camera was.
void predict_record(const FrameRecord& from, const Picture& to, FrameRecord& predicted);

/// What is tracked while it is shown. Allocates nothing after the constructor.
class FrameFeed final : public Feed {
 public:
  /// `fresh` and `seen` have an effect at the pace `newest` alone: elsewhere every picture is tracked before it is
  /// shown.
  FrameFeed(TrackingThread& tracking, Pace pace, PictureTime mode);

  Next advance(Time display_time, bool (*stop)()) override;
  PictureHandle take_picture() override { return std::move(picture_); }
  const FrameRecord& record() const override { return *shown_; }
  Time now() const override { return now_; }
  void hold() override { held_ = true; }
  void skip(Duration by) override;
  Pace pace() const override { return pace_; }
  std::string_view trouble() const override { return tracking_.trouble(); }
  std::uint64_t left_out() const override {
    return tracking_.pictures_dropped() + tracking_.frames_dropped() + tracking_.pictures_lost();
  }
  std::string message() const override { return tracking_.finished() ? tracking_.message() : std::string(); }

 private:
  Next advance_newest(Time display_time);
  Next show_newest(Next next);
  void lose_markers();
  Next advance_at_its_time(Time display_time);
  Next advance_each(bool (*stop)());
  bool take_pending();
  bool skipped_to(Time time);
  Next show_pending();

  TrackingThread& tracking_;
  const Pace pace_;
  const PictureTime mode_;
  PictureHandle picture_, pending_picture_, newest_;
  std::unique_ptr<FrameRecord> tracked_, pending_, predicted_;
  const FrameRecord* shown_;
  bool pending_any_ = false, any_shown_ = false, held_ = true;
  Time began_display_, began_record_;  // The same moment on both clocks.
  Time now_, shown_since_;
  Duration now_ahead_;  // of the record's time
  // On the way to another place of the recording.
  struct Skip {
    Time from, to;
    int passed_over = 0;
  };
  std::optional<Skip> skip_;
};

}  // namespace onestroke
