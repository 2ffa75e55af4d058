// What the tracker remembers from picture to picture.

#include "tracking/tracker.h"

#include "view_fixture.h"

#include <gtest/gtest.h>

#include <cstring>

namespace onestroke::test {
namespace {

const MarkerObservation* find(const FrameRecord& record, int id) {
  for (const MarkerObservation& o : record.seen())
    if (o.id == id) return &o;
  return nullptr;
}

void expect_measured(const FrameRecord& record, int id, const Pose& truth) {
  const MarkerObservation* o = find(record, id);
  ASSERT_NE(o, nullptr) << "marker " << id << " is not reported";
  EXPECT_EQ(o->state, MarkerState::measured);
  EXPECT_LT(turn_between(o->T_camera_marker, truth), 1);
  EXPECT_LT(shift_between(o->T_camera_marker, truth), 3e-3);
}

Pose view(double turn = 0, Vec3 shift = {}) {
  return about_middle(exp_so3({0.4, -0.3, turn}), Vec3{0, 0, 340} + shift);
}

TEST(Tracker, FillsTheWholeRecord) {
  const Catalog catalog = catalog_of(3);
  Tracker tracker(catalog);
  const Shot shot = shoot(catalog.markers[1], view());
  Picture picture = shot.picture(40);
  picture.exposure.length = Duration::from_ms(4);
  picture.exposure.readout = Duration::from_ms(10);
  picture.T_world_camera = {exp_so3({0, 0.2, 0}), {10, 20, 30}};
  const FrameRecord record = process(tracker, picture);
  EXPECT_EQ(record.sequence, 40u);
  EXPECT_EQ(record.time, Time{47'000'000}) << "the middle row's mid-exposure";
  EXPECT_EQ(record.T_world_camera.translation, picture.T_world_camera.translation);
  EXPECT_GT(record.cost.ns, 0);
  ASSERT_EQ(record.marker_count, 1);
  expect_measured(record, 2, view());
  const MarkerObservation& o = record.markers[0];
  EXPECT_STREQ(o.name.data(), "m2");
  EXPECT_EQ(o.cells_seen, 36);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_GT(o.covariance[7 * i], 0);
  EXPECT_EQ(tracker.catalog().markers.size(), 3u);
}

TEST(Tracker, ALongNameIsCut) {
  Catalog catalog = catalog_of(1);
  catalog.markers[0].name = std::string(60, 'x');
  Tracker tracker(catalog);
  const FrameRecord record = process(tracker, shoot(catalog.markers[0], view()).picture());
  ASSERT_EQ(record.marker_count, 1);
  EXPECT_EQ(std::strlen(record.markers[0].name.data()), static_cast<std::size_t>(max_name_length));
}

TEST(Tracker, TwoMarkersKeepTheirNames) {
  const Catalog catalog = catalog_of(6);
  const Pose left = about_middle(exp_so3({0.3, 0.2, 0.4}), {-50, 0, 400});
  const Pose right = about_middle(exp_so3({-0.4, 0.3, -1.2}), {50, 5, 380});
  const Shot shot = shoot({{&catalog.markers[4], left}, {&catalog.markers[0], right}});
  for (const bool independent : {false, true}) {
    Tracker tracker(catalog, {.independent = independent});
    const FrameRecord record = process(tracker, shot.picture());
    EXPECT_EQ(record.marker_count, 2);
    expect_measured(record, 5, left);
    expect_measured(record, 1, right);
  }
}

TEST(Tracker, AMarkerThatIsNotInTheCatalogueIsNotNamed) {
  const Catalog catalog = catalog_of(6);
  const MarkerSpec stranger = angle_marker(17);
  Tracker tracker(catalog);
  for (int i = 0; i < 3; ++i) {
    const Shot shot = shoot(stranger, view(2 * i));
    EXPECT_EQ(process(tracker, shot.picture(33 * i)).marker_count, 0) << i;
  }
}

TEST(Tracker, FollowsAMovingMarkerAndTellsItsVelocity) {
  const Catalog catalog = catalog_of(2);
  Tracker tracker(catalog);
  // 1.5 rad/s about the camera's axis, 120 mm/s to the right, seen 30 times a second.
  const auto truth = [](int i) {
    const double t = i / 30.0;
    return about_middle(exp_so3({0, 0, 1.5 * t}) * exp_so3({0.4, -0.3, 0}), {-20 + 120 * t, 0, 340});
  };
  for (int i = 0; i < 12; ++i) {
    const Shot shot = shoot(catalog.markers[0], truth(i), {.seed = static_cast<std::uint64_t>(i)});
    Picture picture = shot.picture();
    picture.exposure.start = Time{} + Duration::from_seconds(i / 30.0);
    const FrameRecord record = process(tracker, picture);
    EXPECT_EQ(record.marker_count, 1) << i;
    expect_measured(record, 1, truth(i));
    if (i == 0) {
      EXPECT_EQ(norm(record.markers[0].velocity.linear), 0);
    } else {
      EXPECT_NEAR(record.markers[0].velocity.angular.z, 1.5, 0.6) << i;
    }
  }
}

// A hand about one arm and the corner: what the other arm's edges do not tell is what the motion before lets expect.
TEST(Tracker, MeasuresAStickOfWhichOneArmIsCoveredForAWhile) {
  const Catalog catalog = catalog_of(2);
  const RodModel rod(catalog.markers[0]);
  Tracker tracker(catalog);
  const auto truth = [](int i) {
    const double t = i / 30.0;
    return about_middle(exp_so3({0, 0, 0.9 * t}) * exp_so3({0.5, -0.4, 0}), {-15 + 60 * t, 5, 340});
  };
  constexpr int covered_from = 8, pictures = 11;
  for (int i = 0; i < pictures; ++i) {
    Shot shot = shoot(catalog.markers[0], truth(i), {.seed = static_cast<std::uint64_t>(i)});
    for (int c = 15; c < rod.cell_count() && i >= covered_from; ++c) {
      Vec2d middle;
      ASSERT_TRUE(project(shot.intrinsics, to_eigen(truth(i)) * rod.middle(c).centre, middle));
      cover(shot, middle, 12, {196, 148, 120});
    }
    Picture picture = shot.picture();
    picture.exposure.start = Time{} + Duration::from_seconds(i / 30.0);
    const FrameRecord record = process(tracker, picture);
    ASSERT_EQ(record.marker_count, 1) << i;
    const MarkerObservation& o = record.markers[0];
    ASSERT_EQ(o.state, MarkerState::measured) << i;
    Vec2d is, found;
    ASSERT_TRUE(project(shot.intrinsics, to_eigen(truth(i).translation), is));
    ASSERT_TRUE(project(shot.intrinsics, to_eigen(o.T_camera_marker.translation), found));
    EXPECT_LT((found - is).norm(), 0.5) << i;
    EXPECT_LT(angle_between(o.T_camera_marker.rotation, truth(i).rotation), 3 * radian) << i;
  }
}

TEST(Tracker, TheHeadsMotionIsNotTheMarkers) {
  const Catalog catalog = catalog_of(1);
  Tracker tracker(catalog);
  const Pose T_world_marker = view();
  for (int i = 0; i < 6; ++i) {
    const Pose T_world_camera{exp_so3({0.02 * i, 0.03 * i, 0}), {2.0 * i, 0, 0}};
    const Pose truth = inverse(T_world_camera) * T_world_marker;
    const FrameRecord record = process(tracker, shoot(catalog.markers[0], truth).picture(33 * i, T_world_camera));
    expect_measured(record, 1, truth);
    if (i == 0) continue;
    EXPECT_LT(norm(record.markers[0].velocity.angular), 0.3) << i;
    EXPECT_LT(norm(record.markers[0].velocity.linear), 60) << i;
  }
}

class TrackerLoss : public ::testing::Test {
 protected:
  const Catalog catalog = catalog_of(2);
  const Shot with = shoot(catalog.markers[0], view()), without = shoot(std::vector<Placed>{});
  TrackerOptions options{.predict_for = Duration::from_ms(100), .report_lost_for = Duration::from_ms(200)};
};

TEST_F(TrackerLoss, MeasuredThenPredictedThenLostThenGoneAndFoundAgain) {
  Tracker tracker(catalog, options);
  expect_measured(process(tracker, with.picture(0)), 1, view());
  expect_measured(process(tracker, with.picture(50)), 1, view());
  const std::array<double, 36> measured = process(tracker, with.picture(60)).markers[0].covariance;
  for (const int ms : {100, 160}) {
    const FrameRecord record = process(tracker, without.picture(ms));
    ASSERT_EQ(record.marker_count, 1) << ms;
    EXPECT_EQ(record.markers[0].state, MarkerState::predicted) << ms;
    EXPECT_EQ(record.markers[0].cells_seen, 0);
    EXPECT_GT(record.markers[0].covariance[0], measured[0]) << ms;
    EXPECT_LT(turn_between(record.markers[0].T_camera_marker, view()), 3) << ms;
  }
  for (const int ms : {170, 360}) {
    const FrameRecord record = process(tracker, without.picture(ms));
    ASSERT_EQ(record.marker_count, 1) << ms;
    EXPECT_EQ(record.markers[0].state, MarkerState::lost) << ms;
    EXPECT_STREQ(record.markers[0].name.data(), "m1");
  }
  EXPECT_EQ(process(tracker, without.picture(370)).marker_count, 0);
  expect_measured(process(tracker, with.picture(400)), 1, view());
}

TEST_F(TrackerLoss, ALostMarkerComesBackAtOnce) {
  Tracker tracker(catalog, options);
  process(tracker, with.picture(0));
  EXPECT_EQ(process(tracker, without.picture(200)).markers[0].state, MarkerState::lost);
  expect_measured(process(tracker, with.picture(230)), 1, view());
}

TEST_F(TrackerLoss, IndependentPicturesAreForgotten) {
  options.independent = true;
  Tracker tracker(catalog, options);
  for (int i = 0; i < 3; ++i) {
    const FrameRecord record = process(tracker, with.picture(10 * i));
    expect_measured(record, 1, view());
    EXPECT_EQ(norm(record.markers[0].velocity.linear), 0);
    EXPECT_EQ(process(tracker, without.picture(10 * i + 5)).marker_count, 0);
  }
}

TEST_F(TrackerLoss, IndependentAnswersDoNotDependOnTheOrder) {
  options.independent = true;
  Tracker fresh(catalog, options), used(catalog, options);
  const Shot other = shoot(catalog.markers[1], view(1));
  process(used, other.picture(0));
  const FrameRecord a = process(fresh, with.picture(10)), b = process(used, with.picture(10));
  ASSERT_EQ(a.marker_count, 1);
  ASSERT_EQ(b.marker_count, 1);
  EXPECT_LT(turn_between(a.markers[0].T_camera_marker, b.markers[0].T_camera_marker), 1e-9);
  EXPECT_EQ(a.markers[0].T_camera_marker.translation, b.markers[0].T_camera_marker.translation);
}

TEST_F(TrackerLoss, TimeThatGoesBackStartsAfresh) {
  Tracker tracker(catalog, options);
  process(tracker, with.picture(1000));
  EXPECT_EQ(process(tracker, without.picture(10)).marker_count, 0) << "a recording began again";
}

TEST_F(TrackerLoss, AMarkerThatSlidesOutIsPredictedOnItsWay) {
  Tracker tracker(catalog, options);
  Pose last;
  for (int i = 0; i < 4; ++i) {
    last = view(0, {30.0 * i, 0, 0});
    process(tracker, shoot(catalog.markers[0], last).picture(33 * i));
  }
  const FrameRecord record = process(tracker, without.picture(33 * 4));
  ASSERT_EQ(record.marker_count, 1);
  EXPECT_EQ(record.markers[0].state, MarkerState::predicted);
  EXPECT_NEAR((record.markers[0].T_camera_marker.translation - last.translation).x, 30, 3);
}

TEST_F(TrackerLoss, ASecondMarkerIsNoticedWhileTheFirstIsFollowed) {
  Tracker tracker(catalog, options);
  const Pose first = about_middle(exp_so3({0.3, 0.2, 0.4}), {-50, 0, 400});
  const Pose second = about_middle(exp_so3({-0.4, 0.3, -1.2}), {50, 5, 380});
  const Shot one = shoot(catalog.markers[0], first);
  const Shot both = shoot({{&catalog.markers[0], first}, {&catalog.markers[1], second}});
  for (int i = 0; i < 3; ++i) process(tracker, one.picture(33 * i));
  FrameRecord record;
  for (int i = 3; i < 3 + options.search_every; ++i) record = process(tracker, both.picture(33 * i));
  expect_measured(record, 1, first);
  expect_measured(record, 2, second);
}

TEST(Tracker, MayBeMoved) {
  const Catalog catalog = catalog_of(1);
  Tracker first(catalog);
  const Shot shot = shoot(catalog.markers[0], view());
  process(first, shot.picture(0));
  Tracker second(std::move(first));
  EXPECT_EQ(process(second, shot.picture(33)).marker_count, 1);
}

}  // namespace
}  // namespace onestroke::test
