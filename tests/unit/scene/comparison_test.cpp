#include "scene/comparison.h"

#include "sticks.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace onestroke {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;
constexpr double frame_ms = 4;
// A blend covers at most half a turn in its 150 ms, at most at the smooth step's steepest, 1.5 times the mean.
constexpr double steepest_per_ms = 1.5 * std::numbers::pi / 150;

class ComparisonTest : public testing::Test {
 protected:
  // Runs for so long and checks in every frame that no model turned or moved more than it may.
  void run(
      double ms, const std::function<void(double)>& each_frame = [](double) {}) {
    for (const double end = now_ + ms; now_ < end; now_ += frame_ms) {
      each_frame(now_);
      const ComparisonView before = comparison_.view();
      const ComparisonView& after = comparison_.update(record_of({left_, right_}), Time{} + Duration::from_ms(now_));
      for (const Hand h : both_hands) {
        if (before[h].opacity == 0 || before[h].marker_id != after[h].marker_id) continue;
        const double step = angle_between(before[h].world_from_marker.rotation, after[h].world_from_marker.rotation);
        fastest_ = std::max(fastest_, step / frame_ms);
        largest_fade_ = std::max(largest_fade_, std::abs(after[h].opacity - before[h].opacity));
      }
    }
  }
  const ComparisonView& view() const { return comparison_.view(); }
  double shown_angle(Hand h, Quat q) const { return angle_between(view()[h].world_from_marker.rotation, q); }

  std::vector<CarriedModel> carried_{{1, Text("bracket_v1"), {38, -34, 0}}, {2, Text("bracket_v2"), {50, -12, 0}}};
  Comparison comparison_{carried_};
  Stick left_{.id = 1, .place = {-100, 0, 400}, .rotation = from_euler_xyz(0.3, -0.8, 1.9)};
  Stick right_{.id = 2, .place = {100, 20, 400}, .rotation = from_euler_xyz(-1.2, 0.4, -2.0)};
  double now_ = 0;
  double fastest_ = 0, largest_fade_ = 0;
};

void expect_same(const Similarity& a, const Similarity& b) {
  EXPECT_NEAR(a.scale, b.scale, 1e-9);
  EXPECT_NEAR(angle_between(a.rotation, b.rotation), 0, 1e-6);
  EXPECT_NEAR(norm(a.translation - b.translation), 0, 1e-6);
}

TEST_F(ComparisonTest, UnlinkedEachModelIsOnItsOwnStick) {
  run(500);
  EXPECT_EQ(view().mode, CompareMode{});
  expect_same(view()[Hand::left].world_from_marker, {left_.rotation, left_.place, 1});
  expect_same(view()[Hand::right].world_from_marker, {right_.rotation, right_.place, 1});
  EXPECT_EQ(view()[Hand::left].opacity, 1);
  EXPECT_FALSE(view()[Hand::left].leads);
}

TEST_F(ComparisonTest, LinkedBothShowTheLeadersSideEachAtItsOwnStick) {
  run(500);
  comparison_.press('l');
  run(300);
  ASSERT_EQ(view().mode.link, Link::same);
  EXPECT_TRUE(view()[Hand::left].leads);
  EXPECT_NEAR(shown_angle(Hand::left, left_.rotation), 0, 1e-6);
  EXPECT_NEAR(shown_angle(Hand::right, left_.rotation), 0, 1e-6);
  // The follower's middle stays where its own stick holds it.
  const Vec3 pivot = carried_[1].pivot, held = Pose{right_.rotation, right_.place} * pivot;
  EXPECT_NEAR(norm(view()[Hand::right].world_from_marker * pivot - held), 0, 1e-9);
  expect_same(view()[Hand::left].world_from_marker, {left_.rotation, left_.place, 1});
}

TEST_F(ComparisonTest, WhatIsCarriedMayChangeFromFrameToFrame) {
  carried_[1] = {2, Text("loading 40 %"), {}};
  run(500);
  comparison_.press('l');
  run(300);
  EXPECT_THAT(std::string(view()[Hand::right].label.view()), HasSubstr("stick 2 · loading 40 %"));
  // With nothing there yet the stick turns about its corner.
  EXPECT_NEAR(norm(view()[Hand::right].world_from_marker.translation - right_.place), 0, 1e-9);
  carried_[1] = {2, Text("bracket_v2"), {38, -20, 0}};
  run(frame_ms);
  EXPECT_THAT(std::string(view()[Hand::right].label.view()), HasSubstr("stick 2 · bracket_v2"));
  const Vec3 held = Pose{right_.rotation, right_.place} * carried_[1].pivot;
  EXPECT_NEAR(norm(view()[Hand::right].world_from_marker * carried_[1].pivot - held), 0, 1e-9);
}

TEST_F(ComparisonTest, NothingJumpsWhenLinkingUnlinkingOrChangingTheLead) {
  run(500);
  fastest_ = largest_fade_ = 0;
  for (int i = 0; i < 6; ++i) {
    comparison_.press('l');
    // Also in the middle of a blend.
    run(i % 2 == 0 ? 60 : 400);
  }
  EXPECT_GT(fastest_, 0.2 * steepest_per_ms);
  EXPECT_LT(fastest_, 1.05 * steepest_per_ms);
  comparison_.press('l');
  run(400);
  ASSERT_EQ(view().mode.link, Link::same);
  const double turning_per_ms = 2e-3;
  run(1500, [&](double) { right_.rotation = exp_so3({0, turning_per_ms * frame_ms, 0}) * right_.rotation; });
  EXPECT_TRUE(view()[Hand::right].leads);
  EXPECT_NEAR(shown_angle(Hand::left, right_.rotation), 0, 1e-6);
  EXPECT_LT(fastest_, 1.05 * steepest_per_ms + turning_per_ms);
}

TEST_F(ComparisonTest, TheBlendTakesItsTimeAndNoMore) {
  run(500);
  const double whole = angle_between(left_.rotation, right_.rotation);
  comparison_.press('l');
  run(76);
  EXPECT_NEAR(shown_angle(Hand::right, right_.rotation), whole / 2, 0.1 * whole);
  run(80);
  EXPECT_NEAR(shown_angle(Hand::right, left_.rotation), 0, 1e-6);
}

TEST_F(ComparisonTest, TheFollowerFollowsAMovingLeaderWithoutDelay) {
  run(300);
  comparison_.press('l');
  run(400);
  run(1000, [&](double) { left_.rotation = exp_so3({0, 0, 0.01}) * left_.rotation; });
  EXPECT_TRUE(view()[Hand::left].leads);
  EXPECT_NEAR(shown_angle(Hand::right, left_.rotation), 0, 1e-6);
}

TEST_F(ComparisonTest, TremblingDoesNotTakeTheLead) {
  run(300);
  comparison_.press('l');
  const Quat still = right_.rotation;
  run(3000, [&](double ms) { right_.rotation = exp_so3({0.02 * std::sin(ms * 0.05), 0, 0}) * still; });
  EXPECT_TRUE(view()[Hand::left].leads);
}

TEST_F(ComparisonTest, TurningBothTogetherLeavesTheLeadWhereItIs) {
  run(300);
  comparison_.press('l');
  run(2000, [&](double) {
    left_.rotation = exp_so3({0, 0.008, 0}) * left_.rotation;
    right_.rotation = exp_so3({0, 0.008, 0}) * right_.rotation;
  });
  EXPECT_TRUE(view()[Hand::left].leads);
}

TEST_F(ComparisonTest, WhoTurnedBeforeLinkingLeads) {
  run(300);
  run(400, [&](double) { right_.rotation = exp_so3({0, 0.008, 0}) * right_.rotation; });
  comparison_.press('l');
  run(200);
  EXPECT_TRUE(view()[Hand::right].leads);
  EXPECT_NEAR(shown_angle(Hand::left, right_.rotation), 0, 1e-6);
}

TEST_F(ComparisonTest, ALostStickFadesAndComesBackEased) {
  run(500);
  largest_fade_ = 0;
  right_.state = MarkerState::lost;
  run(200);
  EXPECT_GT(view()[Hand::right].opacity, 0.2);
  EXPECT_LT(view()[Hand::right].opacity, 0.8);
  EXPECT_EQ(view()[Hand::right].state, MarkerState::lost);
  EXPECT_FALSE(view().both_visible);
  run(50);
  EXPECT_THAT(std::string(view()[Hand::right].label.view()), HasSubstr("(lost)"));
  run(250);
  EXPECT_EQ(view()[Hand::right].opacity, 0);
  right_.state = MarkerState::measured;
  run(200);
  EXPECT_EQ(view()[Hand::right].opacity, 1);
  EXPECT_LT(largest_fade_, 1.6 * frame_ms / 150);
}

TEST_F(ComparisonTest, ALostStickStaysWhereItWasWhileItFades) {
  run(500);
  const Similarity last = view()[Hand::right].world_from_marker;
  right_.state = MarkerState::lost;
  right_.place = {0, 0, 0};
  run(200);
  expect_same(view()[Hand::right].world_from_marker, last);
}

TEST_F(ComparisonTest, WithoutItsLeaderTheOtherLeads) {
  run(300);
  comparison_.press('l');
  run(300);
  left_.state = MarkerState::lost;
  run(200);
  EXPECT_TRUE(view()[Hand::left].leads);
  run(400);
  EXPECT_TRUE(view()[Hand::right].leads);
  EXPECT_NEAR(shown_angle(Hand::right, right_.rotation), 0, 1e-6);
  EXPECT_LT(fastest_, 1.05 * steepest_per_ms);
}

TEST_F(ComparisonTest, CrossingAndExchangingHandsTurnsNoModel) {
  run(300);
  comparison_.press('l');
  run(300);
  fastest_ = 0;
  std::swap(left_.place, right_.place);
  run(600);
  EXPECT_EQ(view()[Hand::left].marker_id, 1);
  run(600);
  EXPECT_EQ(view()[Hand::left].marker_id, 2);
  EXPECT_TRUE(view()[Hand::right].leads);
  EXPECT_NEAR(shown_angle(Hand::left, left_.rotation), 0, 1e-6);
  EXPECT_LT(fastest_, 1e-6);
}

TEST_F(ComparisonTest, SaysHowTheRightStickStandsToTheLeft) {
  right_.rotation = left_.rotation * from_euler_xyz(30 * degree, 0, 0);
  run(200);
  const RelativePose& r = view().relative;
  EXPECT_NEAR(r.angle_deg, 30, 1e-6);
  EXPECT_NEAR(r.axis.x, 1, 1e-6);
  EXPECT_NEAR(r.euler_deg.x, 30, 1e-6);
  EXPECT_NEAR(r.euler_deg.y, 0, 1e-6);
  EXPECT_NEAR(r.distance, norm(left_.place - right_.place), 1e-9);
  EXPECT_EQ(r.axis_words.view(), "about the stop arm, +x");
  ASSERT_EQ(view().hud().size(), 4U);
  EXPECT_THAT(std::string(view().hud()[0].view()), HasSubstr("Side by side"));
  EXPECT_EQ(view().hud()[1].view(), "Turned 30.0° about the stop arm, +x");
  EXPECT_THAT(std::string(view().hud()[2].view()), testing::StartsWith("Rotation (X, Y, Z) = (30.0°, "));
  EXPECT_EQ(view().hud()[3].view(), "Distance 201 mm");
}

TEST_F(ComparisonTest, NamesTheMarkerItsModelAndItsState) {
  run(100);
  EXPECT_EQ(view()[Hand::left].label.view(), "stick 1 · bracket_v1");
  EXPECT_EQ(view()[Hand::right].label.view(), "stick 2 · bracket_v2");
  right_.state = MarkerState::predicted;
  run(300);
  EXPECT_EQ(view()[Hand::left].label.view(), "stick 1 · bracket_v1");
  EXPECT_EQ(view()[Hand::right].label.view(), "stick 2 · bracket_v2 (predicted)");
  EXPECT_EQ(view()[Hand::right].state, MarkerState::predicted);
  right_.state = MarkerState::measured;
  run(20);
  EXPECT_EQ(view()[Hand::right].label.view(), "stick 2 · bracket_v2");
}

TEST_F(ComparisonTest, DoesNotSpeakOfACoverThatIsGoneAtOnce) {
  run(100);
  for (int i = 0; i < 5; ++i) {
    right_.state = i % 2 ? MarkerState::lost : MarkerState::predicted;
    run(150);
    EXPECT_EQ(view()[Hand::right].label.view(), "stick 2 · bracket_v2");
    right_.state = MarkerState::measured;
    run(50);
  }
}

TEST_F(ComparisonTest, AsksForTheSticksThatAreMissing) {
  left_.state = right_.state = MarkerState::lost;
  run(50);
  EXPECT_EQ(view().hud()[0].view(), "Hold up a stick");
  right_.state = MarkerState::measured;
  run(100);
  EXPECT_EQ(view().hud()[0].view(), "Hold up a second stick to compare");
}

TEST(Text, CutsAtAWholeCharacter) {
  Text t;
  const std::string letters(Text::capacity - 1, 'x');
  t.print("%s°", letters.c_str());
  EXPECT_EQ(t.view(), letters);
  t.print("%s", std::string(2 * Text::capacity, 'y').c_str());
  EXPECT_EQ(t.view().size(), Text::capacity);
  t.print("%s°", letters.substr(1).c_str());
  EXPECT_EQ(t.view(), letters.substr(1) + "°");
}

}  // namespace
}  // namespace onestroke
