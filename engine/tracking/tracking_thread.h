#pragma once

#include "core/camera.h"
#include "core/latest_exchange.h"
#include "core/spsc_queue.h"
#include "core/tracked_frame.h"
#include "tracking/tracker.h"

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

namespace onestroke {

/// Two threads: one takes pictures from a camera, one finds the markers in them. They meet in a latest-picture exchange
/// (a device: the newest picture wins) or in a short queue (a recording: every picture counts and each side waits for
/// the other). The render loop drains the frames without ever waiting.
class TrackingThread {
 public:
  enum class Pacing { newest, every };

  /// Starts at once. Camera and tracker must outlive this object and are its own until it goes.
  TrackingThread(Camera& camera, PictureTracker& tracker, Pacing pacing);
  /// Stops both threads and gives every picture back.
  ~TrackingThread();
  TrackingThread(const TrackingThread&) = delete;
  TrackingThread& operator=(const TrackingThread&) = delete;

  /// Render loop: calls take(TrackedFrame&) for every frame that waits, `limit` at most, oldest first; the picture may
  /// be moved away. Returns how many there were.
  template <typename Take>
  std::size_t drain(Take&& take, std::size_t limit = std::numeric_limits<std::size_t>::max()) {
    return frames_.drain(std::forward<Take>(take), limit);
  }
  /// Render loop, `fresh` mode: the newest picture, tracked or not, if one came since the last call.
  PictureHandle newest_picture() { return fresh_.take(); }

  /// The camera has ended and every frame has been put into the queue; drain once more after it. Any thread.
  bool finished() const { return finished_.load(std::memory_order_acquire); }
  /// Why the camera ended; empty at the plain end of a recording. After finished().
  const std::string& message() const { return message_; }
  /// The camera's. Any thread.
  std::string_view trouble() const { return camera_.trouble(); }
  std::uint64_t pictures_lost() const { return camera_.lost(); }
  /// Pictures that came while the tracker was busy, and frames that came while the render loop was. Any thread.
  std::uint64_t pictures_dropped() const { return newest_.dropped(); }
  std::uint64_t frames_dropped() const { return overflow_.load(std::memory_order_relaxed); }

 private:
  void take_pictures(const std::stop_token& stop);
  void track(const std::stop_token& stop);
  PictureHandle next_picture(const std::stop_token& stop);
  void publish(const std::stop_token& stop, PictureHandle picture, const FrameRecord& record);

  Camera& camera_;
  PictureTracker& tracker_;
  const Pacing pacing_;
  LatestExchange<PictureHandle> newest_, fresh_;
  SpscQueue<PictureHandle> pictures_{2};
  SpscQueue<TrackedFrame> frames_{4};
  std::atomic<bool> camera_ended_{false}, finished_{false};
  std::atomic<std::uint64_t> overflow_{0};
  std::string message_;
  std::jthread camera_thread_, tracking_thread_;
};

}  // namespace onestroke
