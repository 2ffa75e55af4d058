// Two cameras as one. Run under ThreadSanitizer too.

#include "camera/stereo_camera.h"

#include "../core/error_of.h"
#include "allocation/allocation_counter.h"
#include "camera/open_camera.h"
#include "core/picture_pool.h"
#include "core/spsc_queue.h"
#include "scene_fixture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <thread>
#include <vector>

namespace onestroke::test {
namespace {

constexpr std::int64_t ms = 1'000'000;
const Pose T_first_second{exp_so3({0, 0.02, 0}), {64, 0, 0}};

/// A small picture, taken at that time; its first byte is its number.
class Film : public Camera {
 public:
  Film(double rate, bool live, std::string message = {})
      : pool_(6, 3 * width * height), rate_(rate), live_(live), message_(std::move(message)) {}

  std::string message() const override { return message_; }
  bool live() const override { return live_; }
  double rate() const override { return rate_; }
  std::size_t length() const override { return 0; }
  std::size_t lent() const { return pool_.lent(); }

 protected:
  Status make(std::int64_t ns, PictureHandle& picture) {
    PictureHandle::Loan* loan = pool_.acquire();
    if (!loan) return Status::busy;
    Picture& p = loan->picture;
    p.width = width;
    p.height = height;
    p.planes[0] = pool_.bytes(*loan).data();
    p.strides[0] = 3 * width;
    p.intrinsics = Intrinsics::from_fov(width, height, 1);
    p.sequence = made_;
    p.exposure = {Time{ns - ms}, {2 * ms}, {}};
    pool_.bytes(*loan)[0] = static_cast<std::uint8_t>(made_++);
    picture = PictureHandle(*loan);
    return Status::ok;
  }

 private:
  static constexpr int width = 4, height = 3;
  PicturePool pool_;
  double rate_;
  bool live_;
  std::string message_;
  std::uint64_t made_ = 0;
};

/// Pictures of given times, then the end.
class Recorded final : public Film {
 public:
  Recorded(std::vector<std::int64_t> times_ms, double rate, std::string message = {})
      : Film(rate, false, std::move(message)), times_(std::move(times_ms)) {}

  Status next(PictureHandle& picture) override {
    if (at_ == times_.size()) return Status::end;
    const Status status = make(times_[at_] * ms, picture);
    if (status == Status::ok) ++at_;
    return status;
  }
  bool seek(Duration to) override {
    at_ = 0;
    while (at_ < times_.size() && times_[at_] * ms < to.ns) ++at_;
    return true;
  }

 private:
  const std::vector<std::int64_t> times_;
  std::size_t at_ = 0;
};

/// Takes a picture whenever it is told to, from another thread.
class Device final : public Film {
 public:
  explicit Device(double rate = 100) : Film(rate, true) {}

  Status next(PictureHandle& picture) override {
    std::optional<std::int64_t> asked;
    if (asked_.drain([&](std::int64_t& at) { asked = at; }, 1) == 0) {
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      return ended_ ? Status::end : Status::busy;
    }
    return make(*asked, picture);
  }
  std::string_view trouble() const override { return trouble_ ? "it is hot: cool it" : ""; }
  std::uint64_t lost() const override { return 3; }

  void take(std::int64_t at_ms) {
    asked_.push_with([&](std::int64_t& at) { at = at_ms * ms; });
  }
  void end() { ended_ = true; }
  void be_in_trouble() { trouble_ = true; }

 private:
  SpscQueue<std::int64_t> asked_{64};
  std::atomic<bool> ended_{false}, trouble_{false};
};

/// The next one, however often it must be asked for.
PictureHandle next_of(Camera& camera) {
  PictureHandle picture;
  for (;;) {
    const Camera::Status status = camera.next(picture);
    if (status != Camera::Status::busy) return picture;
  }
}

std::pair<int, int> numbers(const Picture& p) {
  return {p.planes[0][0], p.second ? p.second->planes[0][0] : -1};
}

using Numbers = std::vector<std::pair<int, int>>;

Numbers all_of(Camera& camera) {
  Numbers all;
  while (const PictureHandle p = next_of(camera)) all.push_back(numbers(*p));
  return all;
}

std::unique_ptr<Camera> recorded(std::vector<std::int64_t> times, double rate = 100, std::string message = {}) {
  return std::make_unique<Recorded>(std::move(times), rate, std::move(message));
}

TEST(StereoRecordings, PairByTime) {
  StereoCamera camera(recorded({0, 10, 20, 30, 50}), recorded({2, 9, 34, 41, 52}), T_first_second);
  EXPECT_EQ(all_of(camera), (Numbers{{0, 0}, {1, 1}, {2, -1}, {3, 2}, {4, 4}}));
  EXPECT_EQ(camera.message(), "");
}

TEST(StereoRecordings, PairByOrderWhereThereIsNoRate) {
  StereoCamera camera(recorded({0, 0, 0}, 0), recorded({5000, 9, 1}, 0), T_first_second);
  EXPECT_EQ(all_of(camera), (Numbers{{0, 0}, {1, 1}, {2, 2}}));
}

TEST(StereoRecordings, TheFasterOneLeavesPicturesOut) {
  StereoCamera fast(recorded({0, 10, 20, 30}), recorded({0, 20, 40}, 50), T_first_second);
  EXPECT_EQ(all_of(fast), (Numbers{{0, 0}, {1, -1}, {2, 1}, {3, -1}}));
  StereoCamera slow(recorded({0, 20, 40}, 50), recorded({0, 10, 20, 30}), T_first_second);
  EXPECT_EQ(all_of(slow), (Numbers{{0, 0}, {1, 2}, {2, -1}}));
}

TEST(StereoRecordings, AShorterSecondLeavesTheRestToTheFirst) {
  StereoCamera camera(recorded({0, 10, 20}), recorded({0}), T_first_second);
  EXPECT_EQ(all_of(camera), (Numbers{{0, 0}, {1, -1}, {2, -1}}));
}

TEST(StereoRecordings, ADamagedOneEndsBoth) {
  StereoCamera camera(recorded({0, 10, 20}), recorded({0}, 100, "right.mp4 is cut short"), T_first_second);
  EXPECT_EQ(all_of(camera), (Numbers{{0, 0}}));
  EXPECT_EQ(camera.message(), "right.mp4 is cut short");
}

TEST(StereoRecordings, GoOnTogetherFromAnotherTime) {
  StereoCamera camera(recorded({0, 10, 20, 30}), recorded({0, 10, 20, 30}), T_first_second);
  next_of(camera);
  next_of(camera);
  EXPECT_TRUE(camera.seek({20 * ms}));
  EXPECT_EQ(next_of(camera)->exposure.middle().ns, 20 * ms);
  EXPECT_EQ(all_of(camera).size(), 1u);
  EXPECT_TRUE(camera.seek({}));
  const PictureHandle again = next_of(camera);
  EXPECT_EQ(again->exposure.middle().ns, 0);
  ASSERT_TRUE(again->second);
  EXPECT_EQ(again->second->exposure.middle().ns, 0);
}

TEST(StereoRecordings, TheSecondSitsWhereTheRigSays) {
  StereoCamera camera(recorded({0}), recorded({0}), T_first_second);
  PictureHandle pair = next_of(camera);
  const Pose head{exp_so3({0.3, 0, 0}), {1, 2, 3}};
  pair.set_T_world_camera(head);
  const Pose rig = inverse(pair->T_world_camera) * pair->second->T_world_camera;
  EXPECT_LT(norm(rig.translation - T_first_second.translation), 1e-12);
  EXPECT_LT(angle_between(rig.rotation, T_first_second.rotation), 1e-7);
  pair.set_T_world_second({});
  EXPECT_EQ(pair->second->T_world_camera.translation, Vec3{});
  EXPECT_EQ(pair->T_world_camera.translation, head.translation);
}

TEST(StereoRecordings, GiveEveryPictureBack) {
  auto left = std::make_unique<Recorded>(std::vector<std::int64_t>{0, 10, 20, 30, 40, 50, 60, 70}, 100);
  auto right = std::make_unique<Recorded>(std::vector<std::int64_t>{0, 10, 20, 30, 40, 50, 60, 70}, 100);
  const Film &l = *left, &r = *right;
  StereoCamera camera(std::move(left), std::move(right), T_first_second);
  std::vector<PictureHandle> held;
  PictureHandle picture;
  while (camera.next(picture) == Camera::Status::ok) held.push_back(std::move(picture));
  EXPECT_EQ(held.size(), 6u) << "as many as each camera has buffers";
  EXPECT_EQ(camera.lent(), 6u);
  held.erase(held.begin());
  EXPECT_EQ(numbers(*next_of(camera)), (std::pair{6, 6}));
  held.clear();
  EXPECT_EQ(camera.lent(), 0u);
  EXPECT_EQ(l.lent() + r.lent(), 0u);
}

TEST(StereoCameras, AreTwoOfAKind) {
  EXPECT_THAT(error_of([] { StereoCamera(recorded({0}), std::make_unique<Device>(), T_first_second); }),
              testing::HasSubstr("one is a device and the other a recording"));
}

class StereoDevices : public testing::Test {
 protected:
  StereoDevices() {
    auto first = std::make_unique<Device>(), second = std::make_unique<Device>();
    left = first.get();
    right = second.get();
    camera.emplace(std::move(first), std::move(second), T_first_second);
  }

  Device *left, *right;
  std::optional<StereoCamera> camera;
};

TEST_F(StereoDevices, PairWhicheverComesFirst) {
  left->take(10), right->take(12);
  EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{0, 0}));
  right->take(21), left->take(20);
  const PictureHandle pair = next_of(*camera);
  EXPECT_EQ(numbers(*pair), (std::pair{1, 1}));
  EXPECT_EQ(pair->exposure.middle().ns, 20 * ms);
  EXPECT_EQ(pair->second->exposure.middle().ns, 21 * ms);
}

TEST_F(StereoDevices, AMissedPictureLeavesTheOtherAlone) {
  left->take(10), left->take(20), right->take(20);
  EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{0, -1}));
  EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{1, 0}));
}

TEST_F(StereoDevices, OneGoesOnWhileTheOtherIsSilentAndBothWhenItIsBack) {
  left->take(10), right->take(10);
  next_of(*camera);
  for (int i = 2; i < 5; ++i) {
    left->take(10 * i);
    EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{i - 1, -1}));
  }
  left->take(50), right->take(50);
  EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{4, 1}));
  // The right one alone, once the left one has been silent for long enough.
  right->take(600);
  const PictureHandle alone = next_of(*camera);
  EXPECT_EQ(numbers(*alone), (std::pair{2, -1}));
  EXPECT_EQ(alone->T_world_camera.translation, T_first_second.translation) << "it is still where it sits";
  EXPECT_EQ(alone->sequence, 5u) << "numbers go on";
  left->take(610), right->take(610);
  while (left->lent() == 0 || right->lent() < 2) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const PictureHandle pair = next_of(*camera);
  EXPECT_EQ(numbers(*pair), (std::pair{5, 3}));
  EXPECT_EQ(pair->sequence, 6u);
}

TEST_F(StereoDevices, OneThatEndsLeavesTheOther) {
  left->take(10), right->take(10);
  next_of(*camera);
  right->end();
  left->take(20);
  EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{1, -1}));
  left->end();
  EXPECT_FALSE(next_of(*camera));
}

TEST_F(StereoDevices, SayWhatTroublesBoth) {
  EXPECT_EQ(camera->lost(), 6u);
  EXPECT_TRUE(camera->live());
  right->be_in_trouble();
  EXPECT_EQ(camera->trouble(), "") << "the other one gives pictures";
  left->be_in_trouble();
  EXPECT_EQ(camera->trouble(), "it is hot: cool it");
}

TEST_F(StereoDevices, WhatNobodyTakesIsLeftOutAndCounted) {
  PictureHandle picture;
  ASSERT_EQ(camera->next(picture), Camera::Status::busy) << "asked before there is any";
  for (int i = 1; i <= 30; ++i) {
    left->take(10 * i), right->take(10 * i);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  while (left->lent() > 2 || right->lent() > 2) std::this_thread::yield();
  EXPECT_EQ(numbers(*next_of(*camera)), (std::pair{28, 28}));
  EXPECT_EQ(camera->lost(), 6u + 56u);
}

TEST_F(StereoDevices, StopWhileTheyWait) {
  PictureHandle picture;
  EXPECT_EQ(camera->next(picture), Camera::Status::busy);
  left->take(10);
  camera.reset();
}

TEST(StereoLive, StopsAndStartsCleanlyWhateverIsLent) {
  Catalog catalog = two_markers();
  for (int i = 0; i < 20; ++i) {
    CameraOptions options;
    options.spec = "synthetic:live=1,fps=200,width=32,height=24,script=still";
    options.catalog = &catalog;
    StereoCamera camera(open_camera(options), open_camera(options), T_first_second);
    PictureHandle first = next_of(camera), second = next_of(camera);
    first.reset();
    EXPECT_TRUE(second);
  }
}

TEST(StereoLive, AllocatesNothingOnceWarm) {
  StereoCamera camera(recorded(std::vector<std::int64_t>(64, 0), 0), recorded(std::vector<std::int64_t>(64, 0), 0),
                      T_first_second);
  for (int i = 0; i < 8; ++i) next_of(camera);
  const long before = allocations_of_this_thread();
  for (int i = 0; i < 50; ++i) next_of(camera);
  EXPECT_EQ(allocations_of_this_thread(), before);
}

// Both see the same sticks at the same time, each from its own place.
TEST(StereoSynthetic, IsAPerfectPair) {
  const Catalog catalog = two_markers();
  CameraOptions options;
  options.spec = "synthetic:seed=3,width=320,height=240,seconds=0.2";
  options.catalog = &catalog;
  CameraOptions moved = options;
  moved.spec += ",right_mm=64";
  const Pose beside{{}, {64, 0, 0}};
  StereoCamera camera(open_camera(options), open_camera(moved), beside);
  int pairs = 0;
  while (const PictureHandle p = next_of(camera)) {
    ASSERT_TRUE(p->second);
    ++pairs;
    EXPECT_EQ(p->exposure.start, p->second->exposure.start);
    const auto left = camera.truth(*p), right = camera.truth(*p->second);
    ASSERT_EQ(left.size(), 2u);
    ASSERT_EQ(right.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(left[i].id, right[i].id);
      const Pose seen = beside * right[i].T_camera_marker;
      EXPECT_LT(norm(seen.translation - left[i].T_camera_marker.translation), 1e-9);
      EXPECT_LT(angle_between(seen.rotation, left[i].T_camera_marker.rotation), 1e-7);
    }
  }
  EXPECT_EQ(pairs, 6);
}

}  // namespace
}  // namespace onestroke::test
