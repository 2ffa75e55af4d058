// Cutting and measuring by what two sticks do.
#include "compared_sticks.h"

namespace onestroke {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(ComparisonModes, TheStickThatTouchesTheCornerCutsTheOthersModel) {
  run(300);
  touch(StickPoint::corner, StickPoint::start);
  ASSERT_EQ(view().mode.tool, Tool::section);
  EXPECT_EQ(view().pointer, Hand::right);
  EXPECT_FALSE(view()[Hand::right].cut);
  EXPECT_EQ(view()[Hand::right].shown, 0);
  // Through the middle, square to the eye: the half on the eye's side is away.
  right_.rotation = {};
  right_.place = pose(left_) * carried_[0].pivot;
  run(200);
  ASSERT_TRUE(view()[Hand::left].cut);
  const SectionPlane plane = *view()[Hand::left].cut;
  EXPECT_NEAR(std::abs(plane.normal.z), 1, 1e-9);
  EXPECT_NEAR(dot(plane.normal, right_.place) - plane.offset, 0, 1e-9);
  touch(StickPoint::corner, StickPoint::start);
  EXPECT_EQ(view().mode.tool, Tool::none);
  EXPECT_FALSE(view()[Hand::left].cut);
  EXPECT_EQ(view()[Hand::right].shown, 1);
  EXPECT_THAT(events_, ElementsAre("Cut", "End the cut"));
}

TEST_F(ComparisonModes, WhatIsBetweenTheEyesAndThePlaneIsCutAway) {
  for (const double turned : {0.0, 180.0}) {
    Comparison comparison(carried_);
    right_.rotation = exp_so3({turned * degree, 0, 0});
    right_.place = pose(left_) * carried_[0].pivot;
    for (int i = 0; i < 60; ++i) {
      if (i == 10) comparison.press('c');
      comparison.update(record_of({left_, right_}), Time{} + Duration::from_ms(10 * i));
    }
    ASSERT_TRUE(comparison.view()[Hand::left].cut);
    const SectionPlane plane = *comparison.view()[Hand::left].cut;
    EXPECT_LT(dot(plane.normal, Vec3{}), plane.offset) << "the eye is on the side that is cut away";
  }
}

TEST_F(ComparisonModes, APlaneThatIsTurnedRoundCutsFromTheOtherSide) {
  comparison_.press('c');
  right_.place = pose(left_) * carried_[0].pivot;
  right_.rotation = {};
  run(400);
  bool healed = false;
  run(1000, [&](double) {
    right_.rotation = exp_so3({0, 1.8 * degree, 0}) * right_.rotation;
    healed = healed || !view()[Hand::left].cut;
  });
  run(400);
  EXPECT_TRUE(healed);
  ASSERT_TRUE(view()[Hand::left].cut);
  const SectionPlane plane = *view()[Hand::left].cut;
  EXPECT_LT(dot(plane.normal, Vec3{}), plane.offset) << "the eye is on the side that is cut away";
}

TEST_F(ComparisonModes, LinkedModelsAreCutAlike) {
  comparison_.press('l');
  run(300);
  touch(StickPoint::corner, StickPoint::start);
  ASSERT_EQ(view().mode, (CompareMode{Link::same, Tool::section}));
  right_.rotation = exp_so3({0.3, 0.2, 0});
  right_.place = pose(left_) * carried_[0].pivot;
  run(500);
  ASSERT_TRUE(view()[Hand::left].cut && view()[Hand::right].cut);
  // A point of the one model and the same of the other lie on the same side, half as far for one of half the size.
  for (const Vec3 p : {Vec3{0.01, 0.03, -0.02}, Vec3{-0.01, 0.0, 0.01}}) {
    std::array<double, 2> from{};
    for (const Hand h : both_hands) {
      const auto i = static_cast<std::size_t>(h);
      const SectionPlane& cut = *view()[h].cut;
      from[i] = dot(cut.normal, view()[h].world_from_marker * (carried_[i].marker_from_model * p)) - cut.offset;
    }
    EXPECT_NEAR(from[0] * 0.5, from[1], 1e-9);
  }
  // They stand beside each other, the same side to the front.
  EXPECT_EQ(view()[Hand::right].shown, 1);
  EXPECT_NEAR(angle_between(view()[Hand::right].world_from_marker.rotation, left_.rotation), 0, 1e-9);
  const double apart = norm(view()[Hand::left].world_from_marker * carried_[0].pivot -
                            view()[Hand::right].world_from_marker * carried_[1].pivot);
  EXPECT_GT(apart, carried_[0].reach + carried_[1].reach);
}

TEST_F(ComparisonModes, MeasuresBetweenPointsPickedWithTheTip) {
  run(300);
  touch(StickPoint::end, StickPoint::start);
  ASSERT_EQ(view().mode.tool, Tool::measure);
  const std::array<Vec3, 3> points{Vec3{20, -20, 5}, {50, -20, 5}, {50, -45, 5}};
  int picked = 0;
  for (const Vec3 p : points) {
    right_.place = pose(left_) * p - rotate(right_.rotation, stick_points[0]);
    run(500);
    EXPECT_NEAR(view().measure.pick_progress, 0.6, 0.1);
    run(500);
    EXPECT_EQ(view().measure.count, ++picked);
  }
  EXPECT_NEAR(view().measure.distance, 30, 1e-6);
  EXPECT_NEAR(view().measure.distance_2, 25, 1e-6);
  EXPECT_NEAR(view().measure.angle_deg, 90, 1e-6);
  // The points stay with the model.
  left_.rotation = exp_so3({0.2, 0.5, 0}) * left_.rotation;
  right_.place.x += 200;
  run(500);
  EXPECT_NEAR(norm(view().measure.points_world[1] - pose(left_) * points[1]), 0, 1e-6);
  EXPECT_EQ(view().measure.count, 3);
  EXPECT_THAT(std::string(view().hud()[0].view()), HasSubstr("30.0 mm, 25.0 mm, angle 90.0°"));
}

TEST_F(ComparisonModes, MeasuresAModelInItsOwnSize) {
  // The left stick's end tip on the right one's: the left one points now, at a model in half its size.
  run(300);
  touch(StickPoint::start, StickPoint::end);
  ASSERT_EQ(view().mode.tool, Tool::measure);
  EXPECT_EQ(view().pointer, Hand::left);
  for (const Vec3 p : {Vec3{30, -20, 5}, {50, -20, 5}}) {
    left_.place = pose(right_) * p - rotate(left_.rotation, stick_points[0]);
    run(1000);
  }
  EXPECT_NEAR(view().measure.distance, 40, 1e-6);
}

}  // namespace
}  // namespace onestroke
