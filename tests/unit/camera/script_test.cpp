// The script of two hands: smooth, all the way round, near enough, and never through one another.

#include "camera/hand_script.h"
#include "scene_fixture.h"

#include <limits>

namespace onestroke::test {
namespace {

class Script : public testing::Test {
 protected:
  Rod left_{angle_marker(3)}, right_{angle_marker(5, 12)};
  HandScript script_{SyntheticOptions{}, {&left_, &right_}};

  Pose T_camera_marker(std::size_t hand, double t) const {
    return inverse(script_.T_world_camera(t)) * script_.T_world_marker(hand, t);
  }
};

TEST_F(Script, NothingJumpsNotEvenWhereItStartsAgain) {
  constexpr double step = 1.0 / 240;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    Vec3 last_velocity;
    for (int i = 0; i < 50 * 240; ++i) {
      const Pose a = T_camera_marker(hand, i * step), b = T_camera_marker(hand, (i + 1) * step);
      const Vec3 centre = script_.rod(hand).centre();
      const Vec3 velocity = (1 / step) * (b * centre - a * centre);
      ASSERT_LT(norm(velocity), 450) << "mm/s at " << i * step;
      ASSERT_LT(angle_between(a.rotation, b.rotation) / step, 5.0) << "rad/s at " << i * step;
      if (i > 0) {
        ASSERT_LT(norm(velocity - last_velocity) / step, 3000) << "mm/s2 at " << i * step;
      }
      last_velocity = velocity;
    }
  }
}

TEST_F(Script, EachStickTurnsOnceAboutEachAxis) {
  constexpr double step = 1.0 / 100;
  for (std::size_t hand = 0; hand < 2; ++hand) {
    Vec3 turned;
    std::array<bool, 36> about_x{}, about_y{}, about_z{};
    for (int i = 0; i < 2400; ++i) {
      const Quat a = script_.T_world_marker(hand, i * step).rotation;
      const Quat b = script_.T_world_marker(hand, (i + 1) * step).rotation;
      turned = turned + log_so3(b * a.conjugate());
      const auto bin = [](double angle) {
        return static_cast<std::size_t>((std::remainder(angle, 2 * std::numbers::pi) + std::numbers::pi) /
                                        (2 * std::numbers::pi) * 35.999);
      };
      about_x[bin(turned.x)] = about_y[bin(turned.y)] = about_z[bin(turned.z)] = true;
    }
    for (const double angle : {turned.x, turned.y, turned.z}) EXPECT_NEAR(angle, 2 * std::numbers::pi, 0.1);
    for (const auto& bins : {about_x, about_y, about_z}) {
      EXPECT_TRUE(std::all_of(bins.begin(), bins.end(), [](bool seen) { return seen; }));
    }
  }
}

TEST_F(Script, SticksStayWithinReachAndChangePlaces) {
  for (double t = 0; t < script_.period(); t += 0.05) {
    for (std::size_t hand = 0; hand < 2; ++hand) {
      const double distance = norm(T_camera_marker(hand, t) * script_.rod(hand).centre());
      ASSERT_GT(distance, 350) << t;
      ASSERT_LT(distance, 600) << t;
    }
  }
  EXPECT_LT(T_camera_marker(0, 12).translation.x, T_camera_marker(1, 12).translation.x);
  EXPECT_GT(T_camera_marker(0, 17).translation.x, T_camera_marker(1, 17).translation.x);
}

TEST_F(Script, SticksMeetButNeverTouch) {
  const auto gap = [&](double t) {
    double least = std::numeric_limits<double>::max();
    const Pose a = script_.T_world_marker(0, t), b = script_.T_world_marker(1, t);
    for (double s = 0; s <= 144; s += 2) {
      const Vec3 p = a * left_.spec().shape.at(s).position;
      for (double q = 0; q <= 144; q += 2) least = std::min(least, norm(p - b * right_.spec().shape.at(q).position));
    }
    return least - 6;
  };
  double least = std::numeric_limits<double>::max(), meeting = least;
  for (double t = 0; t < script_.period(); t += 0.04) {
    const double g = gap(t);
    least = std::min(least, g);
    if (t > 18.2 && t < 18.8) meeting = std::min(meeting, g);
  }
  EXPECT_GT(least, 8) << "mm between the rods' surfaces";
  EXPECT_LT(meeting, 45);
}

TEST_F(Script, FingersStayOnTheirStick) {
  SyntheticOptions options;
  options.fingers = 2;
  const HandScript script(options, {&left_, &right_});
  ASSERT_EQ(script.capsules(), 3u);
  for (std::size_t hand = 0; hand < 2; ++hand) {
    Vec3 last;
    for (int i = 0; i < 24 * 60; ++i) {
      const double t = i / 60.0;
      const Pose T_world_finger = script.T_world_capsule(hand, 0, t), stick = script.T_world_marker(hand, t);
      if (i > 0) {
        ASSERT_LT(norm(T_world_finger.translation - last), 25) << t;
      }
      last = T_world_finger.translation;
      double near = std::numeric_limits<double>::max();
      for (double s = 0; s <= 144; s += 2) {
        near = std::min(near, norm(stick * script.rod(hand).spec().shape.at(s).position - T_world_finger.translation));
      }
      ASSERT_LT(near, 20) << "the fingertip holds the stick at " << t;
    }
  }
}

}  // namespace
}  // namespace onestroke::test
