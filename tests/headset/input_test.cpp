// Buttons and recentring on a headset whose wearer is scripted. CMake runs this with with_monado.
#include "display/openxr.h"
#include "render/gpu.h"
#include "scripted_head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace onestroke {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Duration longest = Duration::from_seconds(20);

class ScriptedWearer : public testing::Test {
 protected:
  ScriptedWearer() {
    head.use_hands({}, {});
    Gpu gpu({.needs = display.needs()});
    display.attach(gpu);
    // The runtime takes a while to give the program its attention.
    EXPECT_TRUE(blink_until([this] { return seen > 10; }));
    keys.clear();
  }
  ~ScriptedWearer() override { display.finish(); }

  void blink() {
    for (const Key key : display.poll()) keys.push_back(key);
    display.begin(frame);
    if (frame.should_render) ++seen;
    // Nothing is drawn.
    FrameInfo nothing = frame;
    nothing.should_render = false;
    display.end(nothing);
  }
  bool blink_until(const std::function<bool()>& done) {
    for (const Time until = Time::now() + longest; Time::now() < until && !display.closed(); blink())
      if (done()) return true;
    return false;
  }
  void blink_for(Duration length) {
    for (const Time until = Time::now() + length; Time::now() < until;) blink();
  }
  void use_hands(const ScriptedHand& left_hand, const ScriptedHand& right_hand, Duration length) {
    head.use_hands(left_hand, right_hand);
    blink_for(length);
  }
  /// What is done with the hands for a while, and then no more.
  void press(const ScriptedHand& left_hand, const ScriptedHand& right_hand) {
    use_hands(left_hand, right_hand, Duration::from_ms(400));
    use_hands({}, {}, Duration::from_ms(400));
  }
  Pose eyes() const {
    const Pose &left = frame.views[0].T_world_view, &right = frame.views[1].T_world_view;
    return {left.rotation, 0.5 * (left.translation + right.translation)};
  }

  // Straight ahead at first; then turned to the left by 50 degrees, nodding, aside and lower.
  static constexpr double nod = -0.3;
  ScriptedHead head{[](double seconds) {
    if (seconds <= 0) return Pose{{}, {0, -1600, 0}};
    return Pose{exp_so3({0, -50 * std::numbers::pi / 180, 0}) * exp_so3({nod, 0, 0}), {400, -1200, -700}};
  }};
  OpenXrDisplay display;
  FrameInfo frame;
  std::vector<Key> keys;
  int seen = 0;
};

TEST_F(ScriptedWearer, ButtonsAreKeysOnceEach) {
  press({}, {.trigger = true});
  EXPECT_THAT(keys, ElementsAre(Key::enter));
  keys.clear();
  press({.trigger = true}, {});
  EXPECT_THAT(keys, ElementsAre(Key::tab));
  keys.clear();
  press({.b = true}, {});
  press({}, {.b = true});
  EXPECT_THAT(keys, ElementsAre(Key{'n'}, Key{'n'}));
  keys.clear();
  blink_for(Duration::from_ms(500));
  EXPECT_THAT(keys, IsEmpty());
}

TEST_F(ScriptedWearer, AFistThatStaysIsNoTap) {
  use_hands({.curl = 1}, {.curl = 1}, Duration::from_seconds(1.5));
  use_hands({}, {}, Duration::from_seconds(1));
  EXPECT_THAT(keys, IsEmpty());
}

TEST_F(ScriptedWearer, RecentringPutsTheOriginWhereTheHeadIsUprightAndAhead) {
  head.move();
  blink_for(Duration::from_seconds(1));
  EXPECT_GT(angle_between(eyes().rotation, {}), 0.5);
  EXPECT_GT(norm(eyes().translation), 500) << "mm";
  ASSERT_TRUE(display.recentre());
  blink_for(Duration::from_seconds(1));
  EXPECT_NEAR(norm(eyes().translation), 0, 1) << "mm";
  EXPECT_NEAR(angle_between(eyes().rotation, exp_so3({nod, 0, 0})), 0, 1e-3);
  // What was remembered has moved along.
  for (const double ms : {300.0, 1500.0}) {
    const auto then = display.head_at(Time::now() - Duration::from_ms(ms));
    ASSERT_TRUE(then) << ms;
    EXPECT_NEAR(norm(then->translation), 0, 1) << ms;
    EXPECT_NEAR(angle_between(then->rotation, exp_so3({nod, 0, 0})), 0, 1e-3) << ms;
  }
}

}  // namespace
}  // namespace onestroke
