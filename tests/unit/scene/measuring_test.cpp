#include "scene/measuring.h"

#include "scene/section_plane.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

Time at_ms(double ms) {
  return Time{} + Duration::from_ms(ms);
}

TEST(PointPicker, PicksTheMeanOfWhereATremblingHandHolds) {
  PointPicker picker;
  std::optional<Vec3> picked;
  for (double ms = 0; ms < 900 && !picked; ms += 33)
    picked = picker.update(Vec3{10 + 1.5 * std::sin(ms / 20), 5 + std::cos(ms / 27), 400}, at_ms(ms));
  ASSERT_TRUE(picked);
  EXPECT_LT(norm(*picked - Vec3{10, 5, 400}), 0.7);
}

TEST(PointPicker, PicksNothingInPassing) {
  PointPicker picker;
  for (double ms = 0; ms < 5000; ms += 10) EXPECT_FALSE(picker.update(Vec3{ms * 0.02, 0, 400}, at_ms(ms)));
}

TEST(PointPicker, PicksAPlaceOnceUntilItIsLeft) {
  PointPicker picker;
  int count = 0;
  double ms = 0;
  const auto hold = [&](double x) {
    for (const double end = ms + 2000; ms < end; ms += 10) count += picker.update(Vec3{x, 0, 400}, at_ms(ms)) ? 1 : 0;
  };
  hold(0);
  hold(5);
  EXPECT_EQ(count, 1);
  hold(12);
  EXPECT_EQ(count, 2);
  hold(0);
  EXPECT_EQ(count, 3);
}

TEST(PointPicker, LeavesOutWhereItBegins) {
  PointPicker picker;
  picker.leave_out({0, 0, 400});
  int count = 0;
  for (double ms = 0; ms < 2000; ms += 10) count += picker.update(Vec3{0, 1, 400}, at_ms(ms)) ? 1 : 0;
  EXPECT_EQ(count, 0);
  for (double ms = 2000; ms < 3000; ms += 10) count += picker.update(Vec3{0, 15, 400}, at_ms(ms)) ? 1 : 0;
  EXPECT_EQ(count, 1);
}

TEST(PointPicker, ForgivesAShortGapAndNotALongOne) {
  for (const double gap : {200.0, 400.0}) {
    PointPicker picker;
    for (double ms = 0; ms < 500; ms += 10) picker.update(Vec3{0, 0, 400}, at_ms(ms));
    for (double ms = 500; ms < 500 + gap; ms += 10) picker.update(std::nullopt, at_ms(ms));
    picker.update(Vec3{0, 0, 400}, at_ms(500 + gap));
    EXPECT_EQ(picker.progress() > 0.5, gap < 250);
  }
}

TEST(SectionPlane, MovesWithWhatMovesIt) {
  const SectionPlane plane = plane_of_stick({exp_so3({0.3, 0.2, 0.1}), {10, 20, 400}}, false);
  const Similarity map{exp_so3({1, -0.4, 0.2}), {5, -80, 30}, 2.5};
  const SectionPlane there = moved(map, plane);
  EXPECT_NEAR(norm(there.normal), 1, 1e-12);
  for (const Vec3 p : {Vec3{1, 2, 3}, Vec3{100, -50, 380}}) {
    const double before = dot(plane.normal, p) - plane.offset, after = dot(there.normal, map * p) - there.offset;
    EXPECT_NEAR(after, 2.5 * before, 1e-9);
  }
}

TEST(SectionPlane, IsEasedInFromWhereItCutsNothing) {
  const SectionPlane plane{{0, 0, 1}, 410};
  EXPECT_LE(eased_in(plane, {0, 0, 400}, 30, 0).offset, 370);
  EXPECT_EQ(eased_in(plane, {0, 0, 400}, 30, 1).offset, 410);
  // A plane that already leaves it whole stays.
  EXPECT_EQ(eased_in({{0, 0, 1}, 300}, {0, 0, 400}, 30, 0).offset, 300);
}

TEST(Similarity, InverseAndProductAgree) {
  const Similarity a{exp_so3({0.3, 1.2, -0.5}), {1, 2, 3}, 2}, b{exp_so3({-1, 0.2, 0.7}), {-4, 0, 9}, 0.25};
  const Vec3 p{7, -3, 11};
  EXPECT_NEAR(norm((a * b) * p - a * (b * p)), 0, 1e-12);
  EXPECT_NEAR(norm(inverse(a) * (a * p) - p), 0, 1e-12);
}

}  // namespace
}  // namespace onestroke
