#include "app/frame_feed.h"

#include "core/pose_history.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace onestroke {
namespace {

constexpr Duration farthest_ahead = Duration::from_ms(100);
// A recording that is later than this goes on from where it is, rather than hurry.
constexpr Duration late = Duration::from_ms(100);
// Less than half a screen's refresh.
constexpr Duration near_enough = Duration::from_ms(4);
// More pictures than the camera, the tracker and the queues between them hold.
constexpr int most_on_their_way = 16;

}  // namespace

void predict_record(const FrameRecord& from, Time to, FrameRecord& predicted) {
  predicted = from;
  predicted.time = to;
  const Duration ahead = std::clamp(to - from.time, Duration{}, farthest_ahead);
  for (int i = 0; i < predicted.marker_count; ++i) {
    MarkerObservation& m = predicted.markers[static_cast<std::size_t>(i)];
    m.T_camera_marker = advance(m.T_camera_marker, m.velocity, ahead);
  }
}

void predict_record(const FrameRecord& from, const Picture& to, FrameRecord& predicted) {
  predict_record(from, to.exposure.middle(), predicted);
  predicted.sequence = to.sequence;
  predicted.T_world_camera = to.T_world_camera;
  const Pose T_now_then = inverse(to.T_world_camera) * from.T_world_camera;
  for (int i = 0; i < predicted.marker_count; ++i) {
    MarkerObservation& m = predicted.markers[static_cast<std::size_t>(i)];
    m.T_camera_marker = T_now_then * m.T_camera_marker;
  }
}

FrameFeed::FrameFeed(TrackingThread& tracking, Pace pace, PictureTime mode)
    : tracking_(tracking),
      pace_(pace),
      mode_(pace == Pace::newest ? mode : PictureTime::exposure),
      tracked_(std::make_unique<FrameRecord>()),
      pending_(std::make_unique<FrameRecord>()),
      predicted_(std::make_unique<FrameRecord>()),
      shown_(tracked_.get()) {}

FrameFeed::Next FrameFeed::advance(Time display_time, bool (*stop)()) {
  const Time before = shown_->time;
  Next next = Next::same;
  if (pace_ == Pace::newest) next = advance_newest(display_time);
  if (pace_ == Pace::at_its_time) next = advance_at_its_time(display_time);
  if (pace_ == Pace::each) next = advance_each(stop);
  if (shown_->time != before || next == Next::picture) {
    shown_since_ = display_time;
    any_shown_ = true;
  }
  // What fades and gathers goes on while a picture stands, but not for long if no other comes.
  const bool goes_on = any_shown_ && pace_ != Pace::each;
  const bool troubled = pace_ == Pace::newest && !trouble().empty();
  const Duration since = display_time - shown_since_;
  const Duration standing = !goes_on ? Duration{} : troubled ? since : std::min(since, farthest_ahead);
  now_ = std::max(now_, shown_->time + standing + now_ahead_);
  return next;
}

FrameFeed::Next FrameFeed::advance_newest(Time display_time) {
  const bool finished = tracking_.finished();
  Next next = Next::same;
  tracking_.drain([&](TrackedFrame& frame) {
    *tracked_ = frame.record;
    picture_ = std::move(frame.picture);
    next = Next::picture;
  });
  if (finished && next == Next::same) return Next::end;
  shown_ = tracked_.get();
  if (next == Next::same && !trouble().empty()) {
    lose_markers();
    return next;
  }
  if (mode_ == PictureTime::fresh) return show_newest(next);
  if (mode_ == PictureTime::seen && display_time > tracked_->time) {
    predict_record(*tracked_, display_time, *predicted_);
    shown_ = predicted_.get();
  }
  return next;
}

/// Nobody sees them while the camera gives no pictures.
void FrameFeed::lose_markers() {
  *predicted_ = *tracked_;
  for (int i = 0; i < predicted_->marker_count; ++i)
    predicted_->markers[static_cast<std::size_t>(i)].state = MarkerState::lost;
  shown_ = predicted_.get();
}

/// `next` is what came out of the tracker.
FrameFeed::Next FrameFeed::show_newest(Next next) {
  // Every picture is offered here before it is tracked, so this one is at least as new as those above.
  PictureHandle newest = tracking_.newest_picture();
  const bool other = static_cast<bool>(newest);
  if (other) newest_ = newest;
  if (!newest_) return next;
  picture_ = std::move(newest);
  if (newest_->exposure.middle() > tracked_->time) {
    predict_record(*tracked_, *newest_, *predicted_);
    shown_ = predicted_.get();
  }
  return other ? Next::picture : Next::same;
}

FrameFeed::Next FrameFeed::advance_at_its_time(Time display_time) {
  const bool finished = tracking_.finished();
  if (!pending_any_ && !take_pending()) return finished ? Next::end : Next::same;
  const Time due = began_display_ + (pending_->time - began_record_);
  if (held_ || display_time - due > late) {
    began_display_ = display_time;
    began_record_ = pending_->time;
    held_ = false;
  } else if (due - display_time > near_enough) {
    return Next::same;
  }
  return show_pending();
}

FrameFeed::Next FrameFeed::advance_each(bool (*stop)()) {
  for (;;) {
    const bool finished = tracking_.finished();
    if (take_pending()) return show_pending();
    if (finished || stop()) return Next::end;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

void FrameFeed::skip(Duration by) {
  if (pace_ != Pace::at_its_time || !any_shown_) return;
  const Time to = (skip_ ? skip_->to : tracked_->time) + by;
  if (!tracking_.seek(to)) return;
  skip_ = {.from = tracked_->time, .to = to};
  pending_any_ = false;
  pending_picture_.reset();
}

/// Whether a picture of this time comes from where the recording is to go on, rather than was on its way already.
bool FrameFeed::skipped_to(Time time) {
  const bool there = skip_->to < skip_->from ? time <= skip_->from : time >= skip_->to;
  if (!there && skip_->passed_over++ < most_on_their_way) return false;
  now_ahead_ = now_ - time;
  held_ = true;
  skip_.reset();
  return true;
}

bool FrameFeed::take_pending() {
  const auto take = [&](TrackedFrame& frame) {
    *pending_ = frame.record;
    pending_picture_ = std::move(frame.picture);
  };
  do {
    pending_any_ = tracking_.drain(take, 1) > 0;
  } while (pending_any_ && skip_ && !skipped_to(pending_->time));
  return pending_any_;
}

FrameFeed::Next FrameFeed::show_pending() {
  std::swap(tracked_, pending_);
  shown_ = tracked_.get();
  picture_ = std::move(pending_picture_);
  pending_any_ = false;
  return Next::picture;
}

}  // namespace onestroke
