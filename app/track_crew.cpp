#include "app/track_crew.h"

#include "tracking/stereo_tracker.h"

#include <chrono>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace onestroke {

TrackCrew::TrackCrew(Camera& camera, Catalog catalog, const TrackerOptions& options, int threads,
                     std::optional<int> most_pictures)
    : camera_(camera),
      catalog_(std::move(catalog)),
      options_(options),
      threads_(threads),
      most_pictures_(most_pictures) {}

void TrackCrew::run(const Describe& describe, const Deliver& deliver) {
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads_; ++i) others.emplace_back([&] { work(describe, deliver); });
    work(describe, deliver);
  }
  if (failure_) std::rethrow_exception(failure_);
}

bool TrackCrew::take(PictureHandle& picture, std::uint64_t& turn) {
  std::unique_lock lock(mutex_);
  while (!over_) {
    if (most_pictures_ && taken_ == static_cast<std::uint64_t>(*most_pictures_)) {
      over_ = stopped_early_ = true;
      break;
    }
    const Camera::Status status = camera_.next(picture);
    if (status == Camera::Status::ok) {
      turn = taken_++;
      return true;
    }
    if (status == Camera::Status::end) over_ = true;
    // Every buffer is lent to another thread, and nobody tells when it comes back.
    if (status == Camera::Status::busy) changed_.wait_for(lock, std::chrono::milliseconds(1));
  }
  return false;
}

void TrackCrew::work(const Describe& describe, const Deliver& deliver) {
  try {
    StereoTracker tracker(catalog_, options_);
    const auto record = std::make_unique<FrameRecord>();
    PictureHandle picture;
    for (std::uint64_t turn = 0; take(picture, turn);) {
      tracker.process(*picture, *record);
      const std::string line = describe(*picture, *record);
      picture.reset();
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return delivered_ == turn || failure_; });
      if (failure_) return;
      deliver(line, *record);
      ++delivered_;
      changed_.notify_all();
    }
  } catch (...) {
    fail();
  }
}

void TrackCrew::fail() noexcept {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = std::current_exception();
  over_ = true;
  changed_.notify_all();
}

}  // namespace onestroke
