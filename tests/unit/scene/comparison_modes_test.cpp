// The modes of a comparison, entered and left by what two sticks do.
#include "scene/comparison.h"
#include "sticks.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace onestroke {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180, frame_ms = 10, arm = 72;
constexpr StickPoints stick_points{Vec3{0, -arm, 0}, Vec3{}, Vec3{arm, 0, 0}};

CarriedModel carried(int id, Vec3 pivot, double reach, double mm_per_metre) {
  CarriedModel model{.marker_id = id, .words = Text("bracket"), .pivot = pivot, .reach = reach, .points = stick_points};
  model.marker_from_model = {{0, 1, 0, 0}, pivot + Vec3{0, 20, 0}, mm_per_metre};
  return model;
}

void expect_same(const Similarity& a, const Similarity& b, double mm = 1e-6) {
  EXPECT_NEAR(angle_between(a.rotation, b.rotation), 0, 1e-6);
  EXPECT_NEAR(norm(a.translation - b.translation), 0, mm);
  EXPECT_NEAR(a.scale, b.scale, 1e-9);
}

class ComparisonModes : public testing::Test {
 protected:
  void run(
      double ms, const std::function<void(double)>& each_frame = [](double) {}) {
    for (const double end = now_ + ms; now_ < end; now_ += frame_ms) {
      each_frame(now_);
      comparison_.update(record_of({left_, right_}), Time{} + Duration::from_ms(now_));
      for (const std::string_view word : view().happened()) events_.emplace_back(word);
      snapshots_ += view().snapshot ? 1 : 0;
      for (const Hand h : both_hands) watch(h);
    }
  }
  // How far any place of a model goes within a frame.
  void watch(Hand h) {
    Similarity& before = before_[static_cast<std::size_t>(h)];
    const Similarity& now = view()[h].world_from_marker;
    for (const Vec3 p : {Vec3{10, -10, 0}, Vec3{60, -50, 20}})
      farthest_ = std::max(farthest_, norm(now * p - before * p));
    before = now;
  }
  void hold(StickPoint left, StickPoint right, double gap = 6) {
    const Vec3 l = pose(left_) * stick_points[static_cast<std::size_t>(left)];
    const Vec3 r = rotate(right_.rotation, stick_points[static_cast<std::size_t>(right)]);
    right_.place = l - r + Vec3{0, 0, gap};
  }
  void touch(StickPoint left, StickPoint right) {
    const Stick before = right_;
    hold(left, right);
    run(1000);
    right_ = before;
    run(300);
  }
  static Pose pose(const Stick& s) { return {s.rotation, s.place}; }
  const ComparisonView& view() const { return comparison_.view(); }

  std::vector<CarriedModel> carried_{carried(1, {38, -30, 0}, 35, 1000), carried(2, {40, -20, 0}, 30, 500)};
  Comparison comparison_{carried_};
  // The right stick's arms lead away from the left one's.
  Stick left_{.id = 1, .place = {-120, 0, 420}, .rotation = from_euler_xyz(0.3, 0.4, 0.1)};
  Stick right_{.id = 2, .place = {120, 20, 420}, .rotation = from_euler_xyz(-0.2, 0.3, 2.8)};
  double now_ = 0, farthest_ = 0;
  std::array<Similarity, 2> before_;
  std::vector<std::string> events_;
  int snapshots_ = 0;
};

TEST_F(ComparisonModes, TipsTogetherLinkMirrorAndUnlink) {
  run(300);
  for (const Link link : {Link::same, Link::mirrored, Link::apart}) {
    touch(StickPoint::start, StickPoint::start);
    EXPECT_EQ(view().mode, (CompareMode{link, Tool::none}));
  }
  EXPECT_THAT(events_, ElementsAre("Link", "Mirror", "Unlink"));
}

TEST_F(ComparisonModes, ATouchIsOfferedWithItsWordsAndFills) {
  run(300);
  EXPECT_FALSE(view().offer);
  hold(StickPoint::start, StickPoint::start, 25);
  run(100);
  ASSERT_TRUE(view().offer);
  EXPECT_EQ(view().offer->words, "Link");
  EXPECT_EQ(view().offer->progress, 0);
  hold(StickPoint::start, StickPoint::start);
  run(500);
  ASSERT_TRUE(view().offer);
  EXPECT_NEAR(view().offer->progress, 0.5, 0.15);
  const Vec3 tip = pose(left_) * stick_points[0];
  EXPECT_LT(norm(view().offer->place_world - tip), 10);
  // Letting go takes it back.
  hold(StickPoint::start, StickPoint::start, 120);
  run(100);
  EXPECT_FALSE(view().offer);
  EXPECT_EQ(view().mode, CompareMode{});
}

TEST_F(ComparisonModes, MirroredModelsTurnAsInAMirror) {
  comparison_.press('l');
  run(300);
  comparison_.press('l');
  run(300);
  ASSERT_EQ(view().mode.link, Link::mirrored);
  // What faces the wearer does so on both sides; a turn to the right is one to the left.
  left_.rotation = from_euler_xyz(0, 0, 0);
  run(50);
  EXPECT_NEAR(angle_between(view()[Hand::right].world_from_marker.rotation, {}), 0, 1e-9);
  left_.rotation = exp_so3({0.3, 0.5, -0.2});
  run(50);
  EXPECT_NEAR(angle_between(view()[Hand::right].world_from_marker.rotation, exp_so3({0.3, -0.5, 0.2})), 0, 1e-9);
  const Vec3 pivot = carried_[1].pivot;
  EXPECT_NEAR(norm(view()[Hand::right].world_from_marker * pivot - pose(right_) * pivot), 0, 1e-9);
}

TEST_F(ComparisonModes, CornersTogetherLayThePreferredHandsModelOnTheOthers) {
  run(300);
  farthest_ = 0;
  hold(StickPoint::corner, StickPoint::corner);
  run(1300);
  ASSERT_EQ(view().mode.tool, Tool::overlay);
  EXPECT_EQ(view().base, Hand::left);
  EXPECT_EQ(view().laid, 1);
  // By their own frames: the same point of both models lies at the same place.
  const Vec3 p{0.01, 0.03, -0.02};
  const Vec3 on_left = view()[Hand::left].world_from_marker * (carried_[0].marker_from_model * p);
  const Vec3 on_right = view()[Hand::right].world_from_marker * (carried_[1].marker_from_model * p);
  EXPECT_NEAR(norm(on_left - on_right), 0, 1e-9);
  EXPECT_NEAR(view()[Hand::right].world_from_marker.scale, 2, 1e-9);
  // It stays when hands are a little apart, and ends when they part.
  hold(StickPoint::corner, StickPoint::corner, 40);
  run(1000);
  EXPECT_EQ(view().mode.tool, Tool::overlay);
  hold(StickPoint::corner, StickPoint::corner, 70);
  run(300);
  EXPECT_EQ(view().mode.tool, Tool::none);
  EXPECT_THAT(events_, ElementsAre("Lay over", "End"));
}

TEST_F(ComparisonModes, ATwistLaysOverByTheBestFitAndBack) {
  run(300);
  const Similarity fit{exp_so3({0.1, 0, 0.2}), {0.001, 0.002, 0.003}, 1};
  comparison_.set_fit(fit);
  hold(StickPoint::corner, StickPoint::corner);
  run(1300);
  ASSERT_EQ(view().mode.tool, Tool::overlay);
  const Quat before = right_.rotation;
  right_.rotation = exp_so3({0, 60 * degree, 0}) * before;
  run(300);
  ASSERT_TRUE(view().offer);
  EXPECT_EQ(view().offer->words, "Best fit");
  EXPECT_NEAR(view().offer->progress, 0.6, 0.1);
  run(500);
  ASSERT_EQ(view().mode.tool, Tool::fitted);
  const Vec3 p{0.01, 0.03, -0.02};
  const Vec3 on_left = view()[Hand::left].world_from_marker * (carried_[0].marker_from_model * (fit * p));
  const Vec3 on_right = view()[Hand::right].world_from_marker * (carried_[1].marker_from_model * p);
  EXPECT_NEAR(norm(on_left - on_right), 0, 1e-9);
  // Neither 30 degrees nor 50 change it again: it is a catch, not a limit.
  for (const double deg : {30.0, 50.0}) {
    right_.rotation = exp_so3({0, deg * degree, 0}) * before;
    run(1000);
    EXPECT_EQ(view().mode.tool, Tool::fitted) << deg;
  }
  right_.rotation = before;
  run(700);
  EXPECT_EQ(view().mode.tool, Tool::overlay);
  EXPECT_THAT(events_, ElementsAre("Lay over", "Best fit", "Own frames"));
}

TEST_F(ComparisonModes, ALostStickEndsTheOverlay) {
  run(300);
  hold(StickPoint::corner, StickPoint::corner);
  run(1300);
  right_.state = MarkerState::lost;
  run(1000);
  EXPECT_EQ(view().mode.tool, Tool::overlay);
  run(800);
  EXPECT_EQ(view().mode.tool, Tool::none);
}

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

TEST_F(ComparisonModes, AFrozenModelStaysWhileItsStickMoves) {
  run(300);
  const Similarity held = view()[Hand::left].world_from_marker;
  touch(StickPoint::corner, StickPoint::end);
  ASSERT_TRUE(view()[Hand::left].frozen);
  EXPECT_THAT(std::string(view()[Hand::left].label.view()), HasSubstr("(frozen)"));
  const Stick before = left_;
  left_.place = {-150, 60, 380};
  left_.rotation = exp_so3({1, 0, 0}) * left_.rotation;
  run(500);
  expect_same(view()[Hand::left].world_from_marker, held);
  // Also when its stick is laid down.
  left_.state = MarkerState::lost;
  run(4000);
  EXPECT_EQ(view()[Hand::left].opacity, 1);
  expect_same(view()[Hand::left].world_from_marker, held);
  left_ = before;
  run(300);
  touch(StickPoint::corner, StickPoint::end);
  EXPECT_FALSE(view()[Hand::left].frozen);
  left_.place.x -= 20;
  run(300);
  expect_same(view()[Hand::left].world_from_marker, {left_.rotation, left_.place, 1});
}

TEST_F(ComparisonModes, EndTipsTogetherAskForOneSnapshot) {
  run(300);
  touch(StickPoint::end, StickPoint::end);
  EXPECT_EQ(snapshots_, 1);
  EXPECT_EQ(view().mode, CompareMode{});
}

TEST_F(ComparisonModes, AStickNearTheEyesShowsItsCard) {
  run(500);
  EXPECT_EQ(view()[Hand::right].card, 0);
  right_.place = {40, 0, 250};
  run(300);
  EXPECT_EQ(view()[Hand::right].card, 0);
  run(400);
  EXPECT_EQ(view()[Hand::right].card, 1);
  EXPECT_EQ(view()[Hand::left].card, 0);
  right_.place = {40, 0, 320};
  run(500);
  EXPECT_EQ(view()[Hand::right].card, 1);
  right_.place = {40, 0, 400};
  run(300);
  EXPECT_EQ(view()[Hand::right].card, 0);
}

TEST_F(ComparisonModes, NothingJumpsWhateverIsPressed) {
  run(500);
  farthest_ = 0;
  constexpr std::string_view keys = "llcclcclomoobobffmmfolfocl";
  for (std::size_t i = 0; i < keys.size(); ++i) {
    comparison_.press(keys[i]);
    run(i % 3 == 0 ? 60 : 350);
  }
  // 250 mm and half a turn in 150 ms, at the smooth step's steepest.
  EXPECT_GT(farthest_, 5);
  EXPECT_LT(farthest_, 1.5 * (260 + std::numbers::pi * 2 * 85) * frame_ms / 150);
}

TEST_F(ComparisonModes, ForTheLeftHandedTheLeftModelIsLaidOnTheRight) {
  Comparison comparison(carried_, {.left_handed = true});
  for (int i = 0; i < 60; ++i) {
    if (i == 10) comparison.press('o');
    comparison.update(record_of({left_, right_}), Time{} + Duration::from_ms(10 * i));
  }
  EXPECT_EQ(comparison.view().base, Hand::right);
  expect_same(comparison.view()[Hand::right].world_from_marker, {right_.rotation, right_.place, 1});
}

TEST_F(ComparisonModes, RolesStayWithTheirSticksWhenHandsAreExchanged) {
  run(300);
  touch(StickPoint::corner, StickPoint::start);
  ASSERT_EQ(view().pointer, Hand::right);
  comparison_.press('x');
  run(100);
  EXPECT_EQ(view().pointer, Hand::left);
  EXPECT_EQ(view()[Hand::left].marker_id, 2);
  EXPECT_TRUE(view()[Hand::right].cut);
}

TEST_F(ComparisonModes, OneStickHasNoModes) {
  right_.state = MarkerState::lost;
  run(300);
  for (const char key : std::string_view("locm")) {
    comparison_.press(key);
    run(200);
    EXPECT_EQ(view().mode.tool, Tool::none) << key;
  }
  EXPECT_EQ(view()[Hand::left].opacity, 1);
  EXPECT_EQ(view()[Hand::left].shown, 1);
}

}  // namespace
}  // namespace onestroke
