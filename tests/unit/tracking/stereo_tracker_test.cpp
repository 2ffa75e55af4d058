// Two trackers, one a camera. Run under ThreadSanitizer too.

#include "tracking/stereo_tracker.h"

#include "scene_fixture.h"

#include <gtest/gtest.h>

#include <memory>

namespace onestroke::test {
namespace {

const Pose T_first_second{exp_so3({0, -0.12, 0}), {64, 0, 0}};
const Pose there = about_middle(exp_so3({0.3, -0.2, 0.4}), {0, 0, 420});

/// One stick as two cameras see it, which stand still.
class Pair {
 public:
  Pair(const MarkerSpec& marker, const Pose& T_first_marker)
      : left_(shoot(marker, T_first_marker)),
        right_(shoot(marker, inverse(T_first_second) * T_first_marker, {.seed = 2})) {}

  const Picture& at(std::int64_t ms) {
    second_ = right_.picture(ms, T_first_second);
    first_ = left_.picture(ms);
    first_.second = &second_;
    return first_;
  }
  const Picture& left(std::int64_t ms) { return first_ = left_.picture(ms); }
  const Picture& right(std::int64_t ms) { return second_ = right_.picture(ms, T_first_second); }

 private:
  Shot left_, right_;
  Picture first_, second_;
};

class StereoTracking : public testing::Test {
 protected:
  FrameRecord& process(const Picture& picture) {
    tracker.process(picture, *record);
    return *record;
  }

  const Catalog catalog = catalog_of(2);
  StereoTracker tracker{catalog};
  const std::unique_ptr<FrameRecord> record = std::make_unique<FrameRecord>();
  Pair pair{catalog.markers[1], there};
};

TEST_F(StereoTracking, IsFusedFromTwoTrackers) {
  Tracker left(catalog), right(catalog);
  FrameRecord of_left, of_right;
  for (int i = 0; i < 4; ++i) {
    const Picture& picture = pair.at(33 * i);
    left.process(picture, of_left);
    right.process(*picture.second, of_right);
    process(picture);
    EXPECT_EQ(record->sequence, of_left.sequence);
    EXPECT_EQ(record->time, of_left.time);
    ASSERT_EQ(record->marker_count, 1);
    const MarkerObservation& o = record->markers[0];
    EXPECT_EQ(o.state, MarkerState::measured);
    EXPECT_EQ(o.cells_seen, of_left.markers[0].cells_seen);
    EXPECT_EQ(std::popcount(o.second_cells), of_right.markers[0].cells_seen);
    EXPECT_LT(o.covariance[35], of_left.markers[0].covariance[35]);
    EXPECT_LT(norm(o.T_camera_marker.translation - there.translation), 0.3);
    EXPECT_LT(angle_between(o.T_camera_marker.rotation, there.rotation), 0.004);
  }
}

TEST_F(StereoTracking, GoesOnWithOneCameraAndBack) {
  process(pair.at(0));
  for (const Picture* alone : {&pair.left(33), &pair.right(66)}) {
    process(*alone);
    ASSERT_EQ(record->marker_count, 1);
    EXPECT_EQ(record->markers[0].state, MarkerState::measured);
    EXPECT_EQ(record->markers[0].second_cells, 0u);
    const Pose found = record->T_world_camera * record->markers[0].T_camera_marker;
    EXPECT_LT(norm(found.translation - there.translation), 1);
  }
  process(pair.at(100));
  EXPECT_NE(record->markers[0].second_cells, 0u);
}

TEST_F(StereoTracking, StopsAtAnyTime) {
  for (int pictures = 0; pictures < 3; ++pictures) {
    StereoTracker other(catalog);
    for (int i = 0; i < pictures; ++i) other.process(pair.at(33 * i), *record);
    EXPECT_EQ(record->marker_count, pictures > 0 ? 1 : record->marker_count);
  }
}

TEST_F(StereoTracking, PassesOnWhatTheSecondThrows) {
  Picture first = pair.left(0), broken = pair.right(0);
  broken.width = -1;
  first.second = &broken;
  EXPECT_ANY_THROW(process(first));
  // The next pair is none the worse.
  EXPECT_EQ(process(pair.at(33)).marker_count, 1);
}

}  // namespace
}  // namespace onestroke::test
