// What two cameras found, in one record.

#include "tracking/stereo_fusion.h"

#include "core/pose_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace onestroke::test {
namespace {

class StereoFusion : public testing::Test {
 protected:
  StereoFusion() {
    first->T_world_camera = {exp_so3({0.1, 0.4, 0}), {100, 20, -50}};
    second->T_world_camera = first->T_world_camera * T_first_second;
    first->time = second->time = Time{1'000'000'000};
    first->sequence = 7;
  }

  /// sigma: of turns, rad; of shifts 100 times as much, mm.
  static MarkerObservation seen(int id, const Pose& T_camera_marker, MarkerState state = MarkerState::measured,
                                double sigma = 0.002, int cells = 20) {
    MarkerObservation o;
    o.id = id;
    o.name = {'m'};
    o.state = state;
    o.T_camera_marker = T_camera_marker;
    for (std::size_t i = 0; i < 6; ++i) o.covariance[7 * i] = sigma * sigma * (i < 3 ? 1 : 1e4);
    o.cells_seen = state == MarkerState::measured ? cells : 0;
    for (int i = 0; i < cells; ++i) o.cells[static_cast<std::size_t>(i)] = {2 * i, 10.0 * i, 5};
    return o;
  }
  /// Of a marker that is there in the first camera's frame.
  static Pose in_second(const Pose& T_first_marker) { return inverse(T_first_second) * T_first_marker; }
  static void add(FrameRecord& record, const MarkerObservation& o) {
    record.markers[static_cast<std::size_t>(record.marker_count++)] = o;
  }
  const MarkerObservation& only() const {
    EXPECT_EQ(first->marker_count, 1);
    return first->markers[0];
  }
  static void expect_pose(const Pose& a, const Pose& b, double mm = 1e-9) {
    EXPECT_LT(norm(a.translation - b.translation), mm);
    EXPECT_LT(angle_between(a.rotation, b.rotation), 1e-7);
  }

  static inline const Pose T_first_second{exp_so3({0.02, -0.05, 0.01}), {64, 2, -3}};
  static inline const Pose there{exp_so3({0.3, -0.2, 0.9}), {30, -20, 420}};
  static constexpr std::uint64_t even_cells = 0x5555555555;  // 0 to 38
  const std::unique_ptr<FrameRecord> first = std::make_unique<FrameRecord>(), second = std::make_unique<FrameRecord>();
};

TEST_F(StereoFusion, TakesWhatBothSeeTogether) {
  Pose off = there;
  off.translation.x += 0.1;
  add(*first, seen(3, there));
  add(*second, seen(3, in_second(off)));
  fuse_second(*second, *first);
  Pose middle = there;
  middle.translation.x += 0.05;
  // The second's turn and shift are as sure as the first's, in any axes, but for a velocity that nobody is sure of.
  expect_pose(only().T_camera_marker, middle);
  EXPECT_NEAR(only().covariance[0], 0.002 * 0.002 / 2, 1e-12);
  EXPECT_NEAR(only().covariance[35], 0.2 * 0.2 / 2, 1e-9);
  EXPECT_EQ(only().cells_seen, 20);
  EXPECT_EQ(only().cells[3].index, 6);
  EXPECT_EQ(only().second_cells, even_cells);
  EXPECT_EQ(first->sequence, 7u);
}

TEST_F(StereoFusion, IsAsUnsureAsTheyDiffer) {
  Pose off = there;
  off.rotation = exp_so3({0, 0, 0.03}) * there.rotation;
  add(*first, seen(3, there));
  add(*second, seen(3, in_second(off)));
  fuse_second(*second, *first);
  EXPECT_NEAR(angle_between(only().T_camera_marker.rotation, there.rotation), 0.015, 1e-6);
  EXPECT_NEAR(angle_between(only().T_camera_marker.rotation, off.rotation), 0.015, 1e-6);
  // Six independent errors squared in sigmas of the difference, all in one.
  const double squared = 0.03 * 0.03 / (2 * 0.002 * 0.002);
  EXPECT_NEAR(only().covariance[14], 0.002 * 0.002 / 2 * squared / 6, 1e-8);
}

TEST_F(StereoFusion, BelievesTheSurerWhereTheyDisagree) {
  Pose flipped = there;
  flipped.rotation = exp_so3({0, 0, 0.3}) * there.rotation;
  for (const bool second_is_surer : {false, true}) {
    first->marker_count = second->marker_count = 0;
    add(*first, seen(3, there, MarkerState::measured, second_is_surer ? 0.004 : 0.002));
    add(*second, seen(3, in_second(flipped), MarkerState::measured, second_is_surer ? 0.002 : 0.004));
    fuse_second(*second, *first);
    expect_pose(only().T_camera_marker, second_is_surer ? flipped : there);
    EXPECT_NEAR(only().covariance[0], 0.002 * 0.002, 1e-12) << "that of the pose that counts";
  }
}

// Each knows nothing of a turn about an arm, and not quite the same arm.
TEST_F(StereoFusion, IsNotSwungByWhatNeitherTells) {
  const auto seen_by_one_arm = [](const Pose& pose, Vec3 arm) {
    MarkerObservation o = seen(3, pose);
    const std::array<double, 3> a{arm.x, arm.y, arm.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) o.covariance[6 * i + j] += a[i] * a[j];
    return o;
  };
  const Vec3 arm{1, 0, 0}, other_arm = normalized(Vec3{1, 0.01, 0});
  Pose off = there;
  off.rotation = exp_so3({0, 0.004, 0}) * there.rotation;
  add(*first, seen_by_one_arm(there, arm));
  add(*second, seen_by_one_arm(in_second(off), rotate(T_first_second.rotation.conjugate(), other_arm)));
  fuse_second(*second, *first);
  EXPECT_LT(angle_between(only().T_camera_marker.rotation, there.rotation), 0.005);
}

TEST_F(StereoFusion, ReportsWhatOneAloneSees) {
  const Pose elsewhere{exp_so3({1, 0, 0}), {-90, 40, 380}};
  add(*first, seen(3, there));
  add(*second, seen(5, in_second(elsewhere)));
  fuse_second(*second, *first);
  ASSERT_EQ(first->marker_count, 2);
  EXPECT_EQ(first->markers[0].id, 3);
  expect_pose(first->markers[0].T_camera_marker, there);
  EXPECT_EQ(first->markers[0].second_cells, 0u);
  const MarkerObservation& other = first->markers[1];
  EXPECT_EQ(other.id, 5);
  EXPECT_STREQ(other.name.data(), "m");
  EXPECT_EQ(other.state, MarkerState::measured);
  expect_pose(other.T_camera_marker, elsewhere);
  EXPECT_EQ(other.cells_seen, 0) << "in the first picture";
  EXPECT_EQ(other.second_cells, even_cells);
}

TEST_F(StereoFusion, TheBetterStateCountsAndBringsItsPose) {
  const Pose guess{there.rotation, there.translation + Vec3{5, 0, 0}};
  using enum MarkerState;
  struct Case {
    MarkerState first, second, expected;
    bool of_second;
  };
  for (const Case& c : {Case{measured, predicted, measured, false}, Case{predicted, measured, measured, true},
                        Case{lost, measured, measured, true}, Case{measured, lost, measured, false},
                        Case{lost, predicted, predicted, true}, Case{predicted, lost, predicted, false},
                        Case{lost, lost, lost, false}, Case{predicted, predicted, predicted, false}}) {
    first->marker_count = second->marker_count = 0;
    add(*first, seen(3, c.of_second ? guess : there, c.first));
    add(*second, seen(3, in_second(c.of_second ? there : guess), c.second));
    fuse_second(*second, *first);
    EXPECT_EQ(only().state, c.expected);
    expect_pose(only().T_camera_marker, there);
    EXPECT_EQ(only().second_cells != 0, c.second == measured);
  }
}

TEST_F(StereoFusion, CarriesTheSecondToTheFirstsTime) {
  const Velocity velocity{{0, 0, 2}, {300, 0, 0}};  // first camera's axes
  MarkerObservation late = seen(3, {});
  second->time = first->time + Duration::from_ms(8);
  late.T_camera_marker = in_second(advance(there, velocity, Duration::from_ms(8)));
  const Quat to_second = T_first_second.rotation.conjugate();
  late.velocity = {rotate(to_second, velocity.angular), rotate(to_second, velocity.linear)};
  add(*second, late);
  fuse_second(*second, *first);
  expect_pose(only().T_camera_marker, there, 1e-6);
  EXPECT_LT(norm(only().velocity.linear - velocity.linear), 1e-9);
  EXPECT_LT(norm(only().velocity.angular - velocity.angular), 1e-9);
  EXPECT_GT(only().covariance[35], 0.2 * 0.2) << "a velocity is not sure";
}

TEST_F(StereoFusion, KnowsTheHeadsMotionBetweenTheExposures) {
  // The head has turned on when the second picture is taken.
  const Pose T_world_marker = first->T_world_camera * there;
  second->T_world_camera = Pose{exp_so3({0, 0.01, 0}), {3, 0, 1}} * second->T_world_camera;
  add(*first, seen(3, there));
  add(*second, seen(3, inverse(second->T_world_camera) * T_world_marker));
  fuse_second(*second, *first);
  expect_pose(only().T_camera_marker, there);
}

TEST_F(StereoFusion, LeavesOutWhatHasNoRoom) {
  for (int i = 0; i < max_markers_per_frame; ++i) add(*first, seen(i, there));
  for (int i = 8; i < 8 + max_markers_per_frame; ++i) add(*second, seen(i, in_second(there)));
  fuse_second(*second, *first);
  ASSERT_EQ(first->marker_count, max_markers_per_frame);
  for (int i = 0; i < max_markers_per_frame; ++i) {
    EXPECT_EQ(first->markers[static_cast<std::size_t>(i)].id, i) << "no id twice";
    EXPECT_EQ(first->markers[static_cast<std::size_t>(i)].second_cells != 0, i >= 8);
  }
}

}  // namespace
}  // namespace onestroke::test
