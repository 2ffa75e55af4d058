#pragma once

#include "core/camera.h"
#include "core/frame_record.h"
#include "core/frame_sink.h"
#include "tracking/tracker.h"

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace onestroke {

/// Takes every picture of a camera to a tracker, each picture once and the results in the pictures' order. More than
/// one thread is for pictures that have nothing to do with each other: each thread has a tracker of its own.
class TrackCrew {
 public:
  /// Makes a picture's line; on the thread that tracked it, several at a time.
  using Describe = std::function<std::string(const Picture&, const FrameRecord&)>;
  /// Takes a line; on any of the threads, one at a time and in the pictures' order.
  using Deliver = std::function<void(const std::string& line, const FrameRecord&)>;

  /// The sink hears of every picture, in the pictures' order; it is waited for unless the camera is live.
  TrackCrew(Camera& camera, Catalog catalog, const TrackerOptions& options, int threads,
            std::optional<int> most_pictures, FrameSink* sink = nullptr);

  /// Nothing more is taken once this says so; by whoever made the crew, before run().
  void stop_when(bool (*asked)()) { asked_to_stop_ = asked; }
  /// Works until the camera ends or most_pictures are done. The calling thread is one of the threads. Passes on the
  /// first exception of a tracker, of `describe` or of `deliver`.
  void run(const Describe& describe, const Deliver& deliver);
  /// True where most_pictures were taken, or it was asked to stop, before the camera ended.
  bool stopped_early() const { return stopped_early_; }

 private:
  bool take(PictureHandle& picture, std::uint64_t& turn);
  void work(const Describe& describe, const Deliver& deliver);
  void hand_to_sink(const PictureHandle& picture, const FrameRecord& record);
  void fail() noexcept;

  Camera& camera_;
  const Catalog catalog_;
  const TrackerOptions options_;
  const int threads_;
  const std::optional<int> most_pictures_;
  FrameSink* const sink_;
  bool (*asked_to_stop_)() = nullptr;

  std::mutex mutex_;  // over all below, and over camera_
  std::condition_variable changed_;
  std::uint64_t taken_ = 0, delivered_ = 0;
  bool over_ = false, stopped_early_ = false;
  std::exception_ptr failure_;
};

}  // namespace onestroke
