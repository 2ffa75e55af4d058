#include "app/head_camera.h"

#include "counting_camera.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

/// A head that goes 1 mm a ms to the right, is turned by 0.3 rad, and is known between two times.
class Walker final : public HeadTracker {
 public:
  Walker(Time from, Time until) : from_(from), until_(until) {}
  std::optional<Pose> head_at(Time time) const override {
    if (time < from_ || time > until_) return std::nullopt;
    return Pose{exp_so3({0, 0.3, 0}), {Duration{time.ns}.ms(), 0, 0}};
  }

 private:
  Time from_, until_;
};

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_NEAR(norm(a.translation - b.translation), 0, 1e-9);
  EXPECT_NEAR(angle_between(a.rotation, b.rotation), 0, 1e-7);
}

const Pose mount{exp_so3({-0.1, 0, 0.05}), {12, -30, 60}};

TEST(HeadCamera, PicturesAreWhereTheHeadWasWhenTheyWereExposed) {
  const Walker head({0}, {1'000'000'000});
  HeadCamera worn(std::make_unique<CountingCamera>(4), {&head, mount});
  PictureHandle picture;
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(worn.next(picture), Camera::Status::ok);
    expect_same(picture->T_world_camera, Pose{exp_so3({0, 0.3, 0}), {10.0 * i, 0, 0}} * mount);
  }
  EXPECT_EQ(worn.next(picture), Camera::Status::end);
}

TEST(HeadCamera, StaysWhereTheHeadWasKnownLast) {
  const Walker head({5'000'000}, {15'000'000});
  HeadCamera worn(std::make_unique<CountingCamera>(4), {&head, mount});
  PictureHandle picture;
  ASSERT_EQ(worn.next(picture), Camera::Status::ok);
  expect_same(picture->T_world_camera, mount);
  for (int i = 1; i < 4; ++i) {
    ASSERT_EQ(worn.next(picture), Camera::Status::ok);
    expect_same(picture->T_world_camera, Pose{exp_so3({0, 0.3, 0}), {10, 0, 0}} * mount);
  }
}

}  // namespace
}  // namespace onestroke
