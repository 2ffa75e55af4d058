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
};

SyntheticOptions options_of(ScriptKind kind) {
  SyntheticOptions options;
  options.script = kind;
  return options;
}

class ModeScripts : public testing::TestWithParam<Case> {
 protected:
  Rod left_{angle_marker(1)}, right_{angle_marker(2, 8)};
  HandScript script_{options_of(GetParam().kind), {&left_, &right_}};

  Pose T_camera_marker(std::size_t hand, double t) const {
    return inverse(script_.T_world_camera(t)) * script_.T_world_marker(hand, t);
  }
  Vec3 place(std::size_t hand, StickPoint point, double t) const {
    return script_.T_world_marker(hand, t) * script_.rod(hand).spec().shape.vertices()[static_cast<std::size_t>(point)];
  }
  StickPoints points(std::size_t hand, double t) const {
    return {place(hand, start, t), place(hand, corner, t), place(hand, end, t)};
  }
};

TEST_P(ModeScripts, LastAsLongAsAFilm) {
  EXPECT_GE(script_.period(), 8);
  EXPECT_LE(script_.period(), 14);
}

TEST_P(ModeScripts, NothingJumpsNotEvenWhereItStartsAgain) {
  constexpr double step = 1.0 / 240;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    Vec3 last_velocity, last_turn;
    for (int i = 0; i * step < 2.2 * script_.period(); ++i) {
      const Pose a = T_camera_marker(hand, i * step), b = T_camera_marker(hand, (i + 1) * step);
      const Vec3 centre = script_.rod(hand).centre();
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
  for (double t = 0; t < script_.period(); t += 0.05) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
      for (double s = 0; s <= 144; s += 4) {
        const Vec3 p = T_camera_marker(hand, t) * script_.rod(hand).spec().shape.at(s).position;
        ASSERT_LT(std::abs(p.x) + 5, across * p.z) << t;
        ASSERT_LT(std::abs(p.y) + 5, down * p.z) << t;
      }
    }
  }
}

TEST_P(ModeScripts, SticksDoNotPassThroughEachOther) {
  for (double t = 0; t < script_.period(); t += 0.04) {
    const Pose a = script_.T_world_marker(0, t), b = script_.T_world_marker(1, t);
    for (double s = 0; s <= 144; s += 2) {
      const Vec3 p = a * left_.spec().shape.at(s).position;
      for (double q = 0; q <= 144; q += 2) {
        ASSERT_GT(norm(p - b * right_.spec().shape.at(q).position), 5) << t << ' ' << s << ' ' << q;
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
  for (int frame = 0; frame < rounds * rate * script_.period(); ++frame) {
    const double t = static_cast<double>(frame) / rate;
    const auto touch = gesture.update(std::array{points(0, t), points(1, t)}, Time{} + Duration::from_seconds(t));
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
  for (double t = 0; t < script_.period(); t += step) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
      if (norm(T_camera_marker(hand, t).translation) < near_mm) seconds[hand] += step;
    }
  }
  EXPECT_EQ(seconds[0], 0);
  if (GetParam().kind == ScriptKind::card) {
    EXPECT_GT(seconds[1], 2);
  } else {
    EXPECT_EQ(seconds[1], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ModeScripts, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace onestroke::test
