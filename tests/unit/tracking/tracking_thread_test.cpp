// The two threads between a camera and a render loop, on pictures too small to hold a marker. Run under
// ThreadSanitizer too.

#include "tracking/tracking_thread.h"

#include "core/picture_pool.h"
#include "marker_fixture.h"

#include <gtest/gtest.h>

#include <vector>

namespace onestroke::test {
namespace {

/// Numbered pictures of 32 x 24 pixels, as fast as they are taken; then the end.
class CountingCamera : public Camera {
 public:
  /// count 0: endless.
  CountingCamera(std::uint64_t count, std::size_t buffers, bool live, std::string message = {})
      : pool_(buffers, 3 * width * height), count_(count), live_(live), message_(std::move(message)) {}

  Status next(PictureHandle& picture) override {
    if (count_ > 0 && made_ == count_) return Status::end;
    PictureHandle::Loan* loan = pool_.acquire();
    if (!loan) {
      starved_.store(true);
      return Status::busy;
    }
    Picture& p = loan->picture;
    p.width = width;
    p.height = height;
    p.planes[0] = pool_.bytes(*loan).data();
    p.strides[0] = 3 * width;
    p.intrinsics = Intrinsics::from_fov(width, height, 1);
    p.sequence = made_;
    p.exposure.start = {static_cast<std::int64_t>(made_) * 1'000'000};
    pool_.bytes(*loan)[0] = static_cast<std::uint8_t>(made_);
    ++made_;
    picture = PictureHandle(*loan);
    taken_.store(made_);
    return Status::ok;
  }
  std::string message() const override { return message_; }
  bool live() const override { return live_; }
  double rate() const override { return 30; }
  std::size_t length() const override { return count_; }

  std::uint64_t taken() const { return taken_.load(); }
  bool starved() const { return starved_.load(); }
  std::size_t lent() const { return pool_.lent(); }

 private:
  static constexpr int width = 32, height = 24;
  PicturePool pool_;
  std::uint64_t count_, made_ = 0;
  bool live_;
  std::string message_;
  std::atomic<std::uint64_t> taken_{0};
  std::atomic<bool> starved_{false};
};

using Pacing = TrackingThread::Pacing;

/// Takes every frame to the end and checks what each frame owes.
std::vector<std::uint64_t> drain_to_the_end(TrackingThread& thread) {
  std::vector<std::uint64_t> sequences;
  const auto take = [&](TrackedFrame& f) {
    ASSERT_TRUE(f.picture);
    EXPECT_EQ(f.picture->sequence, f.record.sequence);
    EXPECT_EQ(f.picture->exposure.middle(), f.record.time);
    EXPECT_EQ(f.picture->planes[0][0], static_cast<std::uint8_t>(f.record.sequence)) << "overwritten while in use";
    sequences.push_back(f.record.sequence);
  };
  for (;;) {
    const bool last = thread.finished();
    if (thread.drain(take) == 0) std::this_thread::yield();
    if (last) return sequences;
  }
}

class TrackingThreads : public ::testing::Test {
 protected:
  Tracker tracker{catalog_of(2), {.independent = true}};
};

TEST_F(TrackingThreads, EveryPictureArrivesInOrder) {
  CountingCamera camera(60, 4, false);
  {
    TrackingThread thread(camera, tracker, Pacing::every);
    const std::vector<std::uint64_t> got = drain_to_the_end(thread);
    ASSERT_EQ(got.size(), 60u);
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i], i);
    EXPECT_EQ(thread.pictures_dropped(), 0u);
    EXPECT_EQ(thread.frames_dropped(), 0u);
    EXPECT_TRUE(thread.message().empty());
  }
  EXPECT_EQ(camera.lent(), 0u);
}

// The render loop holds back until the camera has no buffer left: nothing may be lost, and it must go on afterwards.
TEST_F(TrackingThreads, ASlowRenderLoopHoldsBackARecording) {
  CountingCamera camera(40, 4, false);
  {
    TrackingThread thread(camera, tracker, Pacing::every);
    while (!camera.starved()) std::this_thread::yield();
    std::vector<PictureHandle> held;
    while (held.size() < 3) thread.drain([&](TrackedFrame& f) { held.push_back(std::move(f.picture)); }, 1);
    for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(held[i]->sequence, i);
    held.clear();
    const std::vector<std::uint64_t> got = drain_to_the_end(thread);
    ASSERT_EQ(got.size(), 37u);
    EXPECT_EQ(got.front(), 3u);
    EXPECT_EQ(got.back(), 39u);
  }
  EXPECT_EQ(camera.lent(), 0u);
}

TEST_F(TrackingThreads, TheNewestPictureWinsAndTheRestIsCounted) {
  CountingCamera camera(400, 12, true);
  {
    TrackingThread thread(camera, tracker, Pacing::newest);
    const std::vector<std::uint64_t> got = drain_to_the_end(thread);
    ASSERT_FALSE(got.empty());
    for (std::size_t i = 1; i < got.size(); ++i) EXPECT_LT(got[i - 1], got[i]);
    EXPECT_EQ(got.size() + thread.pictures_dropped() + thread.frames_dropped(), 400u) << "each is tracked or counted";
    if (thread.frames_dropped() == 0) {
      EXPECT_EQ(got.back(), 399u) << "the last picture is always tracked";
    }
  }
  EXPECT_EQ(camera.lent(), 0u);
}

TEST_F(TrackingThreads, ARenderLoopThatNeverComesStopsNobody) {
  CountingCamera camera(300, 12, true);
  {
    TrackingThread thread(camera, tracker, Pacing::newest);
    while (!thread.finished()) std::this_thread::yield();
    EXPECT_EQ(camera.taken(), 300u);
    std::size_t waiting = thread.drain([](TrackedFrame&) {});
    EXPECT_EQ(waiting + thread.pictures_dropped() + thread.frames_dropped(), 300u);
  }
  EXPECT_EQ(camera.lent(), 0u);
}

TEST_F(TrackingThreads, FreshPicturesComeUntracked) {
  CountingCamera camera(100, 12, true);
  {
    TrackingThread thread(camera, tracker, Pacing::newest);
    PictureHandle newest;
    std::uint64_t last = 0;
    bool any = false;
    for (bool end = false; !end;) {
      end = thread.finished();
      newest = thread.newest_picture();
      thread.drain([](TrackedFrame&) {});
      if (!newest) continue;
      EXPECT_TRUE(!any || newest->sequence > last);
      last = newest->sequence;
      any = true;
    }
    EXPECT_EQ(last, 99u) << "the last picture is the newest";
  }
  EXPECT_EQ(camera.lent(), 0u);
}

TEST_F(TrackingThreads, StopsInTheMiddleAndGivesEverythingBack) {
  for (const Pacing pacing : {Pacing::every, Pacing::newest})
    for (const std::uint64_t after : {0u, 1u, 5u}) {
      CountingCamera camera(0, 6, pacing == Pacing::newest);
      {
        TrackingThread thread(camera, tracker, pacing);
        while (camera.taken() < after) std::this_thread::yield();
      }
      EXPECT_EQ(camera.lent(), 0u);
    }
}

// Stops while the camera waits for a buffer, the tracker for a place in the queue, and a frame is held by its taker.
TEST_F(TrackingThreads, StopsWhileEveryoneWaits) {
  CountingCamera camera(0, 6, false);
  PictureHandle kept;
  {
    TrackingThread thread(camera, tracker, Pacing::every);
    while (!kept) thread.drain([&](TrackedFrame& f) { kept = std::move(f.picture); }, 1);
    while (!camera.starved()) std::this_thread::yield();
  }
  EXPECT_EQ(camera.lent(), 1u) << "the taker's own";
  EXPECT_EQ(kept->sequence, 0u);
  kept.reset();
  EXPECT_EQ(camera.lent(), 0u);
}

TEST_F(TrackingThreads, TheCamerasReasonIsPassedOn) {
  for (const Pacing pacing : {Pacing::every, Pacing::newest}) {
    CountingCamera camera(5, 4, pacing == Pacing::newest, "camera 2 was unplugged; plug it in and start again");
    TrackingThread thread(camera, tracker, pacing);
    EXPECT_FALSE(drain_to_the_end(thread).empty());
    ASSERT_TRUE(thread.finished());
    EXPECT_EQ(thread.message(), "camera 2 was unplugged; plug it in and start again");
  }
}

TEST_F(TrackingThreads, ACameraThatEndsAtOnceIsFinished) {
  class Empty : public CountingCamera {
   public:
    Empty() : CountingCamera(1, 1, false) {}
    Status next(PictureHandle&) override { return Status::end; }
  } camera;
  TrackingThread thread(camera, tracker, Pacing::every);
  EXPECT_TRUE(drain_to_the_end(thread).empty());
}

}  // namespace
}  // namespace onestroke::test
