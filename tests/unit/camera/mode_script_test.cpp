// The scripts that show the ways of comparing: smooth, in the picture, and with the touches that are meant and no
// other.

#include "camera/hand_script.h"
#include "scene/touch_gesture.h"
#include "scene_fixture.h"

#include <algorithm>

namespace onestroke::test {
namespace {

using enum StickPoint;

struct Case {
  const char* name;
  ScriptKind kind;
  std::vector<Touch> touches;  // in one period
};

const std::array cases{
    Case{"side", ScriptKind::side, {}},
    Case{"link", ScriptKind::link, {{start, start}}},
    Case{"mirror", ScriptKind::mirror, {{start, start}, {start, start}}},
    Case{"overlay", ScriptKind::overlay, {{corner, corner}}},
    Case{"section", ScriptKind::section, {{corner, start}, {corner, start}}},
    Case{"measure", ScriptKind::measure, {{end, start}, {end, start}}},
    Case{"freeze", ScriptKind::freeze, {{corner, end}, {corner, end}}},
    Case{"snapshot", ScriptKind::snapshot, {{end, end}}},
    Case{"card", ScriptKind::card, {}},
    Case{"menu", ScriptKind::menu, {{StickPoint::arm, StickPoint::arm}, {StickPoint::arm, StickPoint::arm}}},
};

SyntheticOptions options_of(ScriptKind kind) {
  SyntheticOptions options;
  options.script = kind;
  return options;
}

/// A script of the two hands, with sticks as the demo's are.
class Hands {
 public:
  explicit Hands(ScriptKind kind) : script_{options_of(kind), {&left_, &right_}} {}

  const HandScript& script() const { return script_; }
  double period() const { return script_.period(); }
  const Shape& shape(std::size_t hand) const { return script_.rod(hand).spec().shape; }
  Vec3 centre(std::size_t hand) const { return script_.rod(hand).centre(); }
  Pose T_world_marker(std::size_t hand, double t) const { return script_.T_world_marker(hand, t); }
  Pose T_camera_marker(std::size_t hand, double t) const {
    return inverse(script_.T_world_camera(t)) * T_world_marker(hand, t);
  }
  Vec3 point(std::size_t hand, StickPoint p, double t) const {
    return T_world_marker(hand, t) * shape(hand).vertices()[static_cast<std::size_t>(p)];
  }
  StickPoints points(std::size_t hand, double t) const {
    return {point(hand, start, t), point(hand, corner, t), point(hand, end, t)};
  }
  /// How the right stick is turned as the left one sees it.
  Quat right_on_left(double t) const {
    return T_world_marker(0, t).rotation.conjugate() * T_world_marker(1, t).rotation;
  }

 private:
  Rod left_{angle_marker(1)}, right_{angle_marker(2, 8)};
  HandScript script_;
};

class ModeScripts : public testing::TestWithParam<Case> {
 protected:
  Hands hands_{GetParam().kind};
};

TEST_P(ModeScripts, LastAsLongAsAFilm) {
  EXPECT_GE(hands_.period(), 8);
  EXPECT_LE(hands_.period(), 14);
}

TEST_P(ModeScripts, NothingJumpsNotEvenWhereItStartsAgain) {
  constexpr double step = 1.0 / 240;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    Vec3 last_velocity, last_turn;
    for (int i = 0; i * step < 2.2 * hands_.period(); ++i) {
      const Pose a = hands_.T_camera_marker(hand, i * step), b = hands_.T_camera_marker(hand, (i + 1) * step);
      const Vec3 centre = hands_.centre(hand);
      const Vec3 velocity = (1 / step) * (b * centre - a * centre);
      const Vec3 turn = (1 / step) * log_so3(b.rotation * a.rotation.conjugate());
      ASSERT_LT(norm(velocity), 350) << "mm/s at " << i * step;
      ASSERT_LT(norm(turn), 4.5) << "rad/s at " << i * step;
      if (i > 0) {
        ASSERT_LT(norm(velocity - last_velocity) / step, 2000) << "mm/s2 at " << i * step;
        ASSERT_LT(norm(turn - last_turn) / step, 25) << "rad/s2 at " << i * step;
      }
      last_velocity = velocity;
      last_turn = turn;
    }
  }
}

TEST_P(ModeScripts, BothSticksStayInThePicture) {
  const double across = std::tan(30 * radian), down = across * 9 / 16;
  for (double t = 0; t < hands_.period(); t += 0.05) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
      for (double s = 0; s <= 144; s += 4) {
        const Vec3 p = hands_.T_camera_marker(hand, t) * hands_.shape(hand).at(s).position;
        ASSERT_LT(std::abs(p.x) + 5, across * p.z) << t;
        ASSERT_LT(std::abs(p.y) + 5, down * p.z) << t;
      }
    }
  }
}

TEST_P(ModeScripts, HeadTurnsNoFartherThanItSaysAndSways) {
  constexpr double sway = 0.12;
  double most = 0;
  for (double t = 0; t < hands_.period(); t += 0.05) {
    most = std::max(most, std::abs(log_so3(hands_.script().T_world_camera(t).rotation).y));
  }
  EXPECT_LT(most, hands_.script().head_turn() + sway);
  EXPECT_GT(most, hands_.script().head_turn() - sway);
}

TEST_P(ModeScripts, SticksDoNotPassThroughEachOther) {
  for (double t = 0; t < hands_.period(); t += 0.04) {
    const Pose a = hands_.T_world_marker(0, t), b = hands_.T_world_marker(1, t);
    for (double s = 0; s <= 144; s += 2) {
      const Vec3 p = a * hands_.shape(0).at(s).position;
      for (double q = 0; q <= 144; q += 2) {
        ASSERT_GT(norm(p - b * hands_.shape(1).at(q).position), 5) << t << ' ' << s << ' ' << q;
      }
    }
  }
}

TEST_P(ModeScripts, MakeTheTouchesThatAreMeantAndNoOther) {
  TouchGesture gesture;
  constexpr int rate = 30, rounds = 2;
  std::vector<Touch> made, meant;
  for (int round = 0; round < rounds; ++round) {
    meant.insert(meant.end(), GetParam().touches.begin(), GetParam().touches.end());
  }
  for (int frame = 0; frame < rounds * rate * hands_.period(); ++frame) {
    const double t = static_cast<double>(frame) / rate;
    const auto touch =
        gesture.update(std::array{hands_.points(0, t), hands_.points(1, t)}, Time{} + Duration::from_seconds(t));
    if (touch) made.push_back(*touch);
    if (const auto& candidate = gesture.candidate()) {
      EXPECT_NE(std::ranges::find(meant, *candidate), meant.end()) << "another one begins at " << t;
    }
  }
  EXPECT_EQ(made, meant);
}

TEST_P(ModeScripts, BringAStickNearOnlyToShowItsCard) {
  constexpr double near_mm = 300, step = 0.02;
  std::array<double, 2> seconds{};
  for (double t = 0; t < hands_.period(); t += step) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
      if (norm(hands_.T_camera_marker(hand, t).translation) < near_mm) seconds[hand] += step;
    }
  }
  EXPECT_EQ(seconds[0], 0);
  if (GetParam().kind == ScriptKind::card) {
    EXPECT_GT(seconds[1], 2);
  } else {
    EXPECT_EQ(seconds[1], 0);
  }
}

// What the models' boxes are on their sticks, marker frame; see scene/anchor.h.
constexpr Vec3 model_middle{38, -29, 0};
constexpr double model_depth = 40, model_height = 50;

TEST(ModeScript, OverlayIsSeenFromBothSidesAndThePointerIsTwistedForTheBestFit) {
  const Hands hands(ScriptKind::overlay);
  constexpr double together_from = 1.8, together_until = 12.4, step = 0.02;
  const Quat came = hands.right_on_left(3);
  const Vec3 faced = hands.point(0, end, 3) - hands.point(0, corner, 3);
  double twisted = 0, least = 0, most = 0;
  for (double t = together_from; t < together_until; t += step) {
    ASSERT_LT(norm(hands.point(0, corner, t) - hands.point(1, corner, t)), TouchGesture::near_corners_mm) << t;
    const double twist = angle_between(came, hands.right_on_left(t)) / radian;
    EXPECT_TRUE(t > 8.5 && t < 12 ? twist < 70 : twist < 5) << "only for a while at " << t;
    if (twist > 55) twisted += step;
    const Vec3 arm = hands.point(0, end, t) - hands.point(0, corner, t);
    const double turned = std::atan2(arm.z * faced.x - arm.x * faced.z, arm.x * faced.x + arm.z * faced.z) / radian;
    least = std::min(least, turned);
    most = std::max(most, turned);
  }
  EXPECT_GT(twisted, 1.2);
  EXPECT_LT(least, -45);
  EXPECT_GT(most, 45);
}

TEST(ModeScript, SectionGoesThroughTheWholeModelAtTwoAngles) {
  const Hands hands(ScriptKind::section);
  // How far before the pointer's plane the model's middle is, mm.
  const auto before = [&](double t) {
    return (inverse(hands.T_world_marker(1, t)) * (hands.T_world_marker(0, t) * model_middle)).z;
  };
  const auto angle = [&](double t) {
    return angle_between(hands.T_world_marker(0, t).rotation, hands.T_world_marker(1, t).rotation) / radian;
  };
  EXPECT_GT(before(4.9), model_depth / 2);
  EXPECT_LT(before(7.0), -5);
  EXPECT_LT(angle(5.9), 20);
  EXPECT_GT(std::abs(before(8.05) - before(9.75)), model_height / 2);
  EXPECT_LT(before(8.05) * before(9.75), 0);
  EXPECT_GT(angle(8.8), 30);
}

TEST(ModeScript, MeasuringHoldsTheTipStillAtThreePointsOfTheModel) {
  const Hands hands(ScriptKind::measure);
  constexpr std::array meant{Vec3{68, -10, -20}, Vec3{8, -10, -20}, Vec3{68, -54, 14}};  // corners of the bracket
  for (const Vec3 corner_of_model : meant) {
    double still = 0;
    constexpr double step = 0.02;
    for (double t = 3; t < 11; t += step) {
      const Vec3 tip = inverse(hands.T_world_marker(0, t)) * hands.point(1, start, t);
      if (norm(tip - corner_of_model) < 8) still += step;
    }
    EXPECT_GT(still, 1.2) << corner_of_model.x << ' ' << corner_of_model.y;
    EXPECT_LT(still, 2) << corner_of_model.x << ' ' << corner_of_model.y;
  }
}

TEST(ModeScript, FrozenModelIsLeftAloneAndItsStickTurned) {
  const Hands hands(ScriptKind::freeze);
  const Vec3 model = hands.T_world_marker(0, 2.5) * model_middle;
  EXPECT_GT(norm(hands.T_world_marker(0, 5) * model_middle - model), 80);
  EXPECT_GT(angle_between(hands.T_world_marker(0, 5.1).rotation, hands.T_world_marker(0, 7.3).rotation) / radian, 60);
  EXPECT_LT(norm(hands.T_world_marker(0, 10) * model_middle - model), 5) << "it is unfrozen where it stands";
}

INSTANTIATE_TEST_SUITE_P(All, ModeScripts, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace onestroke::test
