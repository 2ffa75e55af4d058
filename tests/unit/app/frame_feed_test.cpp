#include "app/frame_feed.h"

#include "camera/synthetic_camera.h"
#include "counting_camera.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace onestroke {
namespace {

using Next = FrameFeed::Next;

Time at_ms(double ms) {
  return Time{} + Duration::from_ms(ms);
}
bool never() {
  return false;
}
bool always() {
  return true;
}

/// A stick that lies still, in one picture, and then a camera in trouble.
class TroubledCamera final : public Camera {
 public:
  explicit TroubledCamera(const Catalog& catalog)
      : camera_(make_synthetic_camera(parse_synthetic_options("script=still,width=640,height=480"), catalog)) {}

  Status next(PictureHandle& picture) override {
    return std::exchange(given_, true) ? Status::busy : camera_->next(picture);
  }
  std::string message() const override { return {}; }
  bool live() const override { return true; }
  double rate() const override { return 30; }
  std::size_t length() const override { return 0; }
  std::string_view trouble() const override { return troubled_ ? "it is unplugged" : ""; }
  std::uint64_t lost() const override { return 3; }
  void trouble_it(bool troubled) { troubled_ = troubled; }

 private:
  std::unique_ptr<Camera> camera_;
  bool given_ = false;
  std::atomic<bool> troubled_{false};
};

class FeedTest : public testing::Test {
 protected:
  void start(std::size_t pictures, TrackingThread::Pacing pacing) {
    camera.emplace(pictures);
    tracking.emplace(*camera, tracker, pacing);
  }
  /// Until the thread has put something into the queue; bounded by the test's own time limit.
  Next until_not_same(FrameFeed& feed, Time display_time) {
    for (;;) {
      const Next next = feed.advance(display_time, never);
      if (next != Next::same) return next;
      std::this_thread::yield();
    }
  }

  Tracker tracker{{{{1, "m01", encode(1, 36), Shape::angle(36, 4, 3, 0), ""}}}, {.independent = true}};
  std::optional<CountingCamera> camera;
  std::optional<TrackingThread> tracking;
};

TEST_F(FeedTest, EachPictureIsAFrame) {
  start(20, TrackingThread::Pacing::every);
  FrameFeed feed(*tracking, FrameFeed::Pace::each, PictureTime::fresh);
  for (std::uint64_t i = 0; i < 20; ++i) {
    ASSERT_EQ(feed.advance(at_ms(1000), never), Next::picture);
    const PictureHandle picture = feed.take_picture();
    EXPECT_EQ(picture->sequence, i);
    EXPECT_EQ(feed.record().sequence, i);
    EXPECT_EQ(feed.now(), feed.record().time);
    EXPECT_FALSE(feed.take_picture());
  }
  EXPECT_EQ(feed.advance(at_ms(1000), never), Next::end);
}

TEST_F(FeedTest, WaitingForAPictureCanBeStopped) {
  CountingCamera starved(5, 1);
  PictureHandle held;
  ASSERT_EQ(starved.next(held), Camera::Status::ok);
  tracking.emplace(starved, tracker, TrackingThread::Pacing::every);
  FrameFeed feed(*tracking, FrameFeed::Pace::each, PictureTime::exposure);
  EXPECT_EQ(feed.advance(at_ms(0), always), Next::end);
  tracking.reset();
}

TEST_F(FeedTest, ARecordingIsEnteredAnywhere) {
  start(2000, TrackingThread::Pacing::every);  // a picture every 10 ms
  FrameFeed feed(*tracking, FrameFeed::Pace::at_its_time, PictureTime::exposure);
  feed.skip(Duration::from_seconds(5));
  Time display = at_ms(1000);
  const auto show_next = [&] {
    display = display + Duration::from_ms(10);
    const Time before = feed.now();
    EXPECT_EQ(until_not_same(feed, display), Next::picture);
    EXPECT_TRUE(feed.take_picture());
    EXPECT_GE(feed.now(), before) << "it never goes back";
    EXPECT_LE(feed.now(), before + Duration::from_ms(20)) << "and never leaps";
    return feed.record().sequence;
  };
  EXPECT_EQ(show_next(), 0u) << "before the first picture there is nowhere to go from";
  EXPECT_EQ(show_next(), 1u);
  feed.skip(Duration::from_seconds(5));
  EXPECT_EQ(show_next(), 501u);
  EXPECT_EQ(show_next(), 502u);
  feed.skip(Duration::from_seconds(5));
  feed.skip(Duration::from_seconds(5));
  EXPECT_EQ(show_next(), 1502u) << "twice is twice as far";
  feed.skip(-Duration::from_seconds(5));
  EXPECT_EQ(show_next(), 1002u);
  feed.skip(-Duration::from_seconds(15));
  EXPECT_EQ(show_next(), 0u) << "no farther than to its start";
  for (std::uint64_t i = 1; i < 30; ++i) EXPECT_EQ(show_next(), i) << "at its own pace again";
  feed.skip(Duration::from_seconds(60));
  EXPECT_EQ(until_not_same(feed, display), Next::end);
}

TEST_F(FeedTest, ARecordingComesAtItsOwnPace) {
  start(6, TrackingThread::Pacing::every);  // a picture every 10 ms
  FrameFeed feed(*tracking, FrameFeed::Pace::at_its_time, PictureTime::exposure);
  ASSERT_EQ(until_not_same(feed, at_ms(5000)), Next::picture);
  EXPECT_EQ(feed.record().sequence, 0u);
  EXPECT_EQ(feed.advance(at_ms(5002), never), Next::same);
  EXPECT_EQ(feed.advance(at_ms(5005), never), Next::same);
  EXPECT_EQ(feed.now(), feed.record().time + Duration::from_ms(5));
  ASSERT_EQ(until_not_same(feed, at_ms(5010)), Next::picture);
  EXPECT_EQ(feed.record().sequence, 1u);
  ASSERT_EQ(until_not_same(feed, at_ms(5021)), Next::picture);
  // Much too late: goes on from there instead of rushing.
  ASSERT_EQ(until_not_same(feed, at_ms(6000)), Next::picture);
  EXPECT_EQ(feed.record().sequence, 3u);
  EXPECT_EQ(feed.advance(at_ms(6003), never), Next::same);
  ASSERT_EQ(until_not_same(feed, at_ms(6010)), Next::picture);
  // After a pause the next picture comes at once.
  feed.hold();
  ASSERT_EQ(until_not_same(feed, at_ms(6012)), Next::picture);
  EXPECT_EQ(feed.record().sequence, 5u);
  EXPECT_EQ(until_not_same(feed, at_ms(6050)), Next::end);
}

TEST_F(FeedTest, OfADevicesPicturesTheNewestIsShown) {
  start(200, TrackingThread::Pacing::newest);
  FrameFeed feed(*tracking, FrameFeed::Pace::newest, PictureTime::exposure);
  std::int64_t last = -1;
  Time now;
  while (until_not_same(feed, at_ms(static_cast<double>(++last))) == Next::picture) {
    const PictureHandle picture = feed.take_picture();
    EXPECT_EQ(picture->sequence, feed.record().sequence);
    EXPECT_GE(feed.now(), now);
    now = feed.now();
  }
}

TEST_F(FeedTest, FreshShowsAPictureAtMostAsOldAsItsRecord) {
  start(200, TrackingThread::Pacing::newest);
  FrameFeed feed(*tracking, FrameFeed::Pace::newest, PictureTime::fresh);
  Time shown;
  for (double ms = 0;; ms += 1) {
    const Next next = until_not_same(feed, at_ms(ms));
    if (next == Next::end) break;
    const PictureHandle picture = feed.take_picture();
    EXPECT_GE(picture->exposure.middle(), shown);
    EXPECT_EQ(picture->exposure.middle(), feed.record().time);
    shown = picture->exposure.middle();
  }
  EXPECT_EQ(shown, at_ms(1990)) << "the last picture of all";
}

TEST_F(FeedTest, WhileTheCameraIsAwayItsMarkersAreLostAndTimeGoesOn) {
  TroubledCamera away(tracker.catalog());
  tracking.emplace(away, tracker, TrackingThread::Pacing::newest);
  FrameFeed feed(*tracking, FrameFeed::Pace::newest, PictureTime::exposure);
  ASSERT_EQ(until_not_same(feed, at_ms(5000)), Next::picture);
  ASSERT_EQ(feed.record().marker_count, 1);
  const auto state = [&] { return feed.record().markers[0].state; };
  EXPECT_EQ(state(), MarkerState::measured);
  EXPECT_EQ(feed.left_out(), 3u);
  EXPECT_EQ(feed.advance(at_ms(7000), never), Next::same);
  EXPECT_EQ(state(), MarkerState::measured) << "a slow camera is no lost one";
  EXPECT_EQ(feed.now() - feed.record().time, Duration::from_ms(100));
  away.trouble_it(true);
  EXPECT_EQ(feed.advance(at_ms(8000), never), Next::same);
  EXPECT_EQ(feed.trouble(), "it is unplugged");
  EXPECT_EQ(state(), MarkerState::lost);
  EXPECT_EQ(feed.now() - feed.record().time, Duration::from_ms(3000));
  tracking.reset();
}

TEST_F(FeedTest, WhatIsSeenThroughShowsTheTimeItIsSeenAt) {
  start(200, TrackingThread::Pacing::newest);
  FrameFeed feed(*tracking, FrameFeed::Pace::newest, PictureTime::seen);
  for (double ms = 3000;; ms += 1) {
    const Next next = feed.advance(at_ms(ms), never);
    if (next == Next::end) break;
    EXPECT_EQ(feed.record().time, at_ms(ms)) << "also between pictures";
    EXPECT_EQ(feed.now(), at_ms(ms));
    if (next == Next::picture) {
      EXPECT_EQ(feed.take_picture()->sequence, feed.record().sequence);
    }
  }
}

TEST_F(FeedTest, WhatIsSeenThroughNeverGoesBackToBeforeItsPicture) {
  start(3, TrackingThread::Pacing::newest);
  FrameFeed feed(*tracking, FrameFeed::Pace::newest, PictureTime::seen);
  while (until_not_same(feed, at_ms(-1000)) != Next::end)
    EXPECT_EQ(feed.record().time, feed.take_picture()->exposure.middle());
}

FrameRecord moving_record() {
  FrameRecord record;
  record.sequence = 4;
  record.time = at_ms(1000);
  record.T_world_camera = {exp_so3({0, 0.3, 0}), {10, 20, 30}};
  record.marker_count = 2;
  for (MarkerObservation& m : record.markers) m.state = MarkerState::measured;
  record.markers[0].T_camera_marker = {exp_so3({0.1, 0.2, 0.3}), {5, 6, 400}};
  record.markers[0].velocity = {{0.7, -1.1, 2}, {100, 0, -50}};
  record.markers[1].T_camera_marker = {exp_so3({0, 0, 1}), {-50, 0, 500}};
  return record;
}

/// Where a marker of constant world velocity is, from what the record says of it at its own time.
Pose moved(const FrameRecord& record, const MarkerObservation& m, double seconds) {
  const Pose world = record.T_world_camera * m.T_camera_marker;
  const Quat turn = record.T_world_camera.rotation;
  return {exp_so3(seconds * rotate(turn, m.velocity.angular)) * world.rotation,
          world.translation + seconds * rotate(turn, m.velocity.linear)};
}

TEST(PredictRecord, AMarkerOfConstantVelocityIsWhereItWillBe) {
  const FrameRecord from = moving_record();
  FrameRecord predicted;
  for (const double ms : {0.0, 1.0, 16.7, 60.0, 100.0}) {
    predict_record(from, at_ms(1000 + ms), predicted);
    EXPECT_EQ(predicted.time, at_ms(1000 + ms));
    EXPECT_EQ(predicted.sequence, from.sequence);
    EXPECT_EQ(predicted.T_world_camera.translation, from.T_world_camera.translation) << "of the picture";
    for (std::size_t i = 0; i < 2; ++i) {
      const Pose world = predicted.T_world_camera * predicted.markers[i].T_camera_marker;
      const Pose truth = moved(from, from.markers[i], ms / 1000);
      EXPECT_NEAR(norm(world.translation - truth.translation), 0, 1e-9) << ms;
      EXPECT_NEAR(angle_between(world.rotation, truth.rotation), 0, 1e-7) << ms;
    }
  }
}

TEST(PredictRecord, NothingIsCarriedFartherThanATenthOfASecondOrBack) {
  const FrameRecord from = moving_record();
  FrameRecord predicted;
  predict_record(from, at_ms(9000), predicted);
  EXPECT_EQ(predicted.time, at_ms(9000));
  EXPECT_NEAR(norm(predicted.markers[0].T_camera_marker.translation - Vec3{15, 6, 395}), 0, 1e-9);
  predict_record(from, at_ms(900), predicted);
  EXPECT_EQ(predicted.markers[0].T_camera_marker.translation, from.markers[0].T_camera_marker.translation);
}

TEST(PredictRecord, CarriesMarkersOnByTheirVelocities) {
  FrameRecord from;
  from.time = at_ms(1000);
  from.T_world_camera = {exp_so3({0, 0.3, 0}), {10, 20, 30}};
  from.marker_count = 1;
  MarkerObservation& m = from.markers[0];
  m.state = MarkerState::measured;
  m.T_camera_marker = {exp_so3({0.1, 0.2, 0.3}), {5, 6, 400}};
  m.velocity = {{0, 0, 2}, {100, 0, -50}};
  Picture to;
  to.sequence = 9;
  to.exposure.start = at_ms(1050);
  to.T_world_camera = {exp_so3({0, 0.35, 0}), {12, 20, 30}};
  FrameRecord predicted;
  predict_record(from, to, predicted);
  EXPECT_EQ(predicted.sequence, 9u);
  EXPECT_EQ(predicted.time, at_ms(1050));
  const Pose expected{exp_so3({0, 0, 0.1}) * m.T_camera_marker.rotation, {10, 6, 397.5}};
  const Pose world = from.T_world_camera * expected;
  const Pose got = predicted.T_world_camera * predicted.markers[0].T_camera_marker;
  EXPECT_NEAR(norm(got.translation - world.translation), 0, 1e-9);
  EXPECT_NEAR(angle_between(got.rotation, world.rotation), 0, 1e-7);

  to.exposure.start = at_ms(5000);
  predict_record(from, to, predicted);
  const Vec3 far = from.T_world_camera * Vec3{15, 6, 395};
  EXPECT_NEAR(norm(predicted.T_world_camera * predicted.markers[0].T_camera_marker.translation - far), 0, 1e-9)
      << "100 ms at most";
}

}  // namespace
}  // namespace onestroke
