#pragma once

#include "scene/comparison.h"
#include "stick_points.h"
#include "sticks.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace onestroke {

inline constexpr double degree = std::numbers::pi / 180, frame_ms = 10;

inline CarriedModel carried(int id, Vec3 pivot, double reach, double mm_per_metre) {
  CarriedModel model{.marker_id = id, .words = Text("bracket"), .pivot = pivot, .reach = reach, .points = stick_points};
  model.marker_from_model = {{0, 1, 0, 0}, pivot + Vec3{0, 20, 0}, mm_per_metre};
  return model;
}

inline void expect_same(const Similarity& a, const Similarity& b, double mm = 1e-6) {
  EXPECT_NEAR(angle_between(a.rotation, b.rotation), 0, 1e-6);
  EXPECT_NEAR(norm(a.translation - b.translation), 0, mm);
  EXPECT_NEAR(a.scale, b.scale, 1e-9);
}

/// Two sticks that do what a test says, and the comparison that sees them.
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

}  // namespace onestroke
