#include "tracking/stereo_tracker.h"

#include "tracking/stereo_fusion.h"

#include <pthread.h>

#include <exception>
#include <semaphore>
#include <thread>

namespace onestroke {

/// The second camera's tracker on its thread.
class StereoTracker::Second {
 public:
  Second(const Catalog& catalog, const TrackerOptions& options)
      : tracker_(catalog, options), thread_([this](const std::stop_token& stop) {
          pthread_setname_np(pthread_self(), "tracking 2");
          work(stop);
        }) {}
  ~Second() {
    thread_.request_stop();
    go_.release();
  }

  /// Between the two the picture must stay.
  void begin(const Picture& picture) {
    picture_ = &picture;
    go_.release();
  }
  const FrameRecord& wait() {
    done_.acquire();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return record_;
  }

 private:
  void work(const std::stop_token& stop) {
    for (;;) {
      go_.acquire();
      if (stop.stop_requested()) return;
      try {
        tracker_.process(*picture_, record_);
      } catch (...) {
        failure_ = std::current_exception();
      }
      done_.release();
    }
  }

  Tracker tracker_;
  FrameRecord record_;
  const Picture* picture_ = nullptr;
  std::exception_ptr failure_;
  std::binary_semaphore go_{0}, done_{0};
  std::jthread thread_;
};

StereoTracker::StereoTracker(Catalog catalog, const TrackerOptions& options)
    : catalog_(std::move(catalog)), options_(options), first_(catalog_, options) {}
StereoTracker::~StereoTracker() = default;

void StereoTracker::process(const Picture& picture, FrameRecord& record) {
  if (!picture.second) return first_.process(picture, record);
  const Time began = Time::now();
  if (!second_) second_ = std::make_unique<Second>(catalog_, options_);
  second_->begin(*picture.second);
  std::exception_ptr failure;
  try {
    first_.process(picture, record);
  } catch (...) {
    failure = std::current_exception();
  }
  const FrameRecord& second = second_->wait();
  if (failure) std::rethrow_exception(failure);
  fuse_second(second, record);
  record.cost = Time::now() - began;
}

}  // namespace onestroke
