#pragma once

#include "app/feed.h"
#include "app/session_reader.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "core/picture_pool.h"

#include <map>
#include <utility>

namespace onestroke {

/// A session shown again from its log, a frame of the log a frame. The records are the log's, and the pictures those of
/// the camera that have the records' numbers; dark ones of the same size and lens stand for those that it cannot give.
class ReplayFeed final : public Feed, public HeadTracker {
 public:
  /// The session outlives the feed.
  explicit ReplayFeed(SessionReader& session) : session_(session) {}
  /// Where pictures come from; null, as at first, for dark ones alone. Outlives the feed, and is its own until it goes.
  void use(Camera* camera) { camera_ = camera; }

  /// Where the head was in the log's frame of now, whatever the time: for a camera that draws its pictures again. None
  /// where the session tracked no head. The feed's own thread.
  std::optional<Pose> head_at(Time) const override;

  Next advance(Time display_time, bool (*stop)()) override;
  PictureHandle take_picture() override { return std::move(picture_); }
  const FrameRecord& record() const override { return frame_ ? frame_->record : none_; }
  Time now() const override { return frame_ ? frame_->now : Time{}; }
  void hold() override {}
  /// Without those that ended or held the show: its frames are the log's.
  std::span<const Key> keys() const override { return {keys_.begin(), keys_.size()}; }
  Pace pace() const override { return Pace::each; }
  std::string message() const override { return message_; }
  std::uint64_t dark_pictures() const { return dark_pictures_; }

 private:
  const SessionFrame* next_frame();
  PictureHandle find_picture(bool (*stop)());
  void go_back();
  PictureHandle dark_picture();
  void take_keys();

  SessionReader& session_;
  Camera* camera_ = nullptr;
  bool camera_over_ = false;
  const SessionFrame* frame_ = nullptr;  // the reader's
  const FrameRecord none_{};
  std::map<std::pair<int, int>, PicturePool> dark_;  // By width and height; outlives the handles below.
  PictureHandle picture_;
  PictureHandle ahead_;     // The camera's newest, where it is not yet the log's turn to show it.
  std::uint64_t seen_ = 0;  // One more than the number of the camera's newest.
  InlineVector<Key, SessionFrame::most_keys> keys_;
  std::uint64_t dark_pictures_ = 0;
  std::string message_;
};

}  // namespace onestroke
