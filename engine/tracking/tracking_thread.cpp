#include "tracking/tracking_thread.h"

#include <pthread.h>

#include <chrono>
#include <memory>

namespace onestroke {
namespace {

// Short against a picture's time, long against a wake-up's cost.
void pause() {
  std::this_thread::sleep_for(std::chrono::microseconds(300));
}

}  // namespace

TrackingThread::TrackingThread(Camera& camera, PictureTracker& tracker, Pacing pacing)
    : camera_(camera), tracker_(tracker), pacing_(pacing) {
  camera_thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "camera");
    take_pictures(stop);
  });
  tracking_thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "tracking");
    track(stop);
  });
}

TrackingThread::~TrackingThread() {
  camera_thread_.request_stop();
  tracking_thread_.request_stop();
}

void TrackingThread::take_pictures(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    PictureHandle picture;
    const Camera::Status status = camera_.next(picture);
    if (status == Camera::Status::end) break;
    if (status == Camera::Status::busy) {
      pause();
      continue;
    }
    if (pacing_ == Pacing::newest) {
      fresh_.publish(picture);
      newest_.publish(std::move(picture));
    } else {
      const auto put = [&](PictureHandle& slot) { slot = std::move(picture); };
      while (!pictures_.push_with(put) && !stop.stop_requested()) pause();
    }
  }
  message_ = camera_.message();
  camera_ended_.store(true, std::memory_order_release);
}

PictureHandle TrackingThread::next_picture(const std::stop_token& stop) {
  PictureHandle picture;
  while (!stop.stop_requested()) {
    // Read before looking: what was published before the end is then certainly seen.
    const bool ended = camera_ended_.load(std::memory_order_acquire);
    if (pacing_ == Pacing::newest) {
      picture = newest_.take();
    } else {
      pictures_.drain([&](PictureHandle& p) { picture = std::move(p); }, 1);
    }
    if (picture || ended) break;
    pause();
  }
  return picture;
}

void TrackingThread::publish(const std::stop_token& stop, PictureHandle picture, const FrameRecord& record) {
  const auto write = [&](TrackedFrame& f) {
    f.picture = std::move(picture);
    f.record = record;
  };
  if (frames_.push_with(write)) return;
  if (pacing_ == Pacing::newest) {
    overflow_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  while (!stop.stop_requested()) {
    pause();
    if (frames_.push_with(write)) return;
  }
}

void TrackingThread::track(const std::stop_token& stop) {
  const auto record = std::make_unique<FrameRecord>();
  while (PictureHandle picture = next_picture(stop)) {
    tracker_.process(*picture, *record);
    record->tracked = Time::now();
    publish(stop, std::move(picture), *record);
  }
  finished_.store(true, std::memory_order_release);
}

}  // namespace onestroke
