#include "camera/open_camera.h"
#include "core/error.h"
#include "scene_fixture.h"

#include <vector>

namespace onestroke::test {
namespace {

class Synthetic : public testing::Test {
 protected:
  Catalog catalog_ = two_markers();

  std::unique_ptr<Camera> open(const std::string& settings) {
    CameraOptions options;
    options.spec = "synthetic:" + settings;
    options.catalog = &catalog_;
    return open_camera(options);
  }
  static std::vector<std::uint8_t> bytes(const Picture& p) {
    return {p.planes[0], p.planes[0] + p.strides[0] * static_cast<std::size_t>(p.height)};
  }
};

TEST_F(Synthetic, GivesPicturesWithTimesAndTruth) {
  const auto camera = open("width=320,height=180,fps=50,seconds=0.1,exposure_ms=4,readout_ms=10,head=0");
  EXPECT_EQ(camera->length(), 5u);
  EXPECT_DOUBLE_EQ(camera->rate(), 50);
  EXPECT_FALSE(camera->live());
  for (std::uint64_t i = 0; i < 5; ++i) {
    const PictureHandle p = take(*camera);
    ASSERT_TRUE(p);
    EXPECT_EQ(p->sequence, i);
    EXPECT_EQ(p->exposure.start.ns, static_cast<std::int64_t>(i) * 20'000'000);
    EXPECT_EQ(p->exposure.length.ns, 4'000'000);
    EXPECT_EQ(p->exposure.readout.ns, 10'000'000);
    EXPECT_DOUBLE_EQ(p->intrinsics.cx, 160);
    const auto truth = camera->truth(*p);
    ASSERT_EQ(truth.size(), 2u);
    EXPECT_EQ(truth[0].id, 3);
    EXPECT_EQ(truth[1].id, 5);
  }
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::end);
  EXPECT_EQ(camera->message(), "");
}

/// Turns by 1 rad a second.
struct Turning final : HeadTracker {
  std::optional<Pose> head_at(Time time) const override {
    return Pose{exp_so3({0, Duration{time.ns}.seconds(), 0}), {20, 0, 0}};
  }
};

TEST_F(Synthetic, SeesFromTheHeadThatWearsIt) {
  const Turning head;
  const Pose T_head_camera{exp_so3({0.05, 0, 0}), {0, -30, 50}};
  CameraOptions options;
  options.spec = "synthetic:script=still,width=320,height=180,fps=50,seconds=0.1,exposure_ms=4,noise=0";
  options.catalog = &catalog_;
  const auto still = open_camera(options);
  options.mount = {&head, T_head_camera};
  const auto worn = open_camera(options);
  for (int i = 0; i < 5; ++i) {
    const PictureHandle seen = take(*worn), unmoved = take(*still);
    ASSERT_TRUE(seen && unmoved);
    const Pose expected = *head.head_at(seen->exposure.middle()) * T_head_camera;
    EXPECT_NEAR(norm(seen->T_world_camera.translation - expected.translation), 0, 1e-9);
    EXPECT_NEAR(angle_between(seen->T_world_camera.rotation, expected.rotation), 0, 1e-7);
    // The stick stands where it does in its script's world.
    const Pose there = seen->T_world_camera * worn->truth(*seen)[0].T_camera_marker;
    const Pose here = unmoved->T_world_camera * still->truth(*unmoved)[0].T_camera_marker;
    EXPECT_NEAR(norm(there.translation - here.translation), 0, 1e-9);
    EXPECT_NEAR(angle_between(there.rotation, here.rotation), 0, 1e-7);
  }
}

TEST_F(Synthetic, TruthBelongsToTheMiddleOfTheExposure) {
  // A steady turn of 10 degrees a picture at 10 pictures a second is 100 degrees a second: at mid-exposure of the
  // middle row, 30 ms after the start, the stick has turned by 3 degrees more.
  const auto camera =
      open("width=320,height=240,fps=10,script=turn_z,step_deg=10,exposure_ms=20,readout_ms=40,marker=5,distance=400");
  EXPECT_EQ(camera->length(), 36u);
  for (int i = 0; i < 4; ++i) {
    const PictureHandle p = take(*camera);
    const auto truth = camera->truth(*p);
    ASSERT_EQ(truth.size(), 1u);
    EXPECT_EQ(truth[0].id, 5);
    EXPECT_NEAR(to_euler_xyz(truth[0].T_camera_marker.rotation).z, (10 * i + 3) * radian, 1e-9);
    EXPECT_EQ(truth[0].cells_visible, 36);
    EXPECT_NEAR((p->exposure.middle() - p->exposure.start).ms(), 30, 1e-9);
  }
}

TEST_F(Synthetic, TurnScriptsGoRoundOnceAboutTheirAxis) {
  for (const auto& [name, axis] :
       {std::pair<std::string, Vec3>{"turn_x", {1, 0, 0}}, {"turn_y", {0, 1, 0}}, {"turn_z", {0, 0, 1}}}) {
    const auto camera = open("width=64,height=48,step_deg=30,distance=500,script=" + name);
    ASSERT_EQ(camera->length(), 12u);
    const Rod rod(catalog_.markers[0]);
    for (int i = 0; i < 12; ++i) {
      const PictureHandle p = take(*camera);
      const Pose pose = camera->truth(*p)[0].T_camera_marker;
      EXPECT_NEAR(angle_between(pose.rotation, exp_so3(30 * i * radian * axis)), 0, 1e-6) << name << " " << i;
      EXPECT_NEAR(norm(pose * rod.centre() - Vec3{0, 0, 500}), 0, 1e-6);
    }
  }
}

TEST_F(Synthetic, TheHeadsPoseConnectsWorldAndCamera) {
  const auto swaying = open("width=64,height=48"), still = open("width=64,height=48,head=0");
  for (int i = 0; i < 10; ++i) {
    const PictureHandle a = take(*swaying), b = take(*still);
    EXPECT_GT(norm(a->T_world_camera.translation), 0.1);
    EXPECT_EQ(norm(b->T_world_camera.translation), 0);
    const Pose in_world = a->T_world_camera * swaying->truth(*a)[0].T_camera_marker;
    const Pose expected = still->truth(*b)[0].T_camera_marker;
    EXPECT_NEAR(norm(in_world.translation - expected.translation), 0, 1e-9);
    EXPECT_NEAR(angle_between(in_world.rotation, expected.rotation), 0, 1e-7);
  }
}

TEST_F(Synthetic, SeedsDecideEveryByte) {
  const auto a = open("width=160,height=90,seed=4"), b = open("width=160,height=90,seed=4,threads=2"),
             c = open("width=160,height=90,seed=5");
  take(*a).reset();
  take(*b).reset();
  take(*c).reset();
  const PictureHandle pa = take(*a), pb = take(*b), pc = take(*c);
  EXPECT_EQ(bytes(*pa), bytes(*pb));
  EXPECT_NE(bytes(*pa), bytes(*pc));
}

TEST_F(Synthetic, FingersHideCells) {
  const auto bare = open("width=640,height=360,head=0"), held = open("width=640,height=360,head=0,fingers=2");
  int without = 0, with = 0;
  for (int i = 0; i < 130; ++i) {
    const PictureHandle a = take(*bare), b = take(*held);
    if (i < 100) continue;
    for (std::size_t m = 0; m < 2; ++m) {
      without += bare->truth(*a)[m].cells_visible;
      with += held->truth(*b)[m].cells_visible;
    }
  }
  EXPECT_LT(with, 0.95 * without);
  EXPECT_GT(with, 0.5 * without);
}

TEST_F(Synthetic, IsBusyWhileAllBuffersAreLentAndGoesOnWhenOneComesBack) {
  const auto camera = open("width=64,height=48");
  std::vector<PictureHandle> held;
  PictureHandle picture;
  while (camera->next(picture) == Camera::Status::ok) {
    held.push_back(std::move(picture));
    ASSERT_LT(held.size(), 100u);
  }
  EXPECT_EQ(camera->next(picture), Camera::Status::busy);
  EXPECT_GE(held.size(), 4u);
  const std::uint64_t last = held.back()->sequence;
  held.erase(held.begin());
  ASSERT_EQ(camera->next(picture), Camera::Status::ok);
  EXPECT_EQ(picture->sequence, last + 1) << "no picture is lost while the camera is busy";
  EXPECT_TRUE(camera->truth(Picture{}).empty());
}

TEST_F(Synthetic, LiveStampsRealTimes) {
  const auto camera = open("width=64,height=48,fps=200,live=1");
  EXPECT_TRUE(camera->live());
  const Time before = Time::now();
  Time last{};
  std::uint64_t sequence = 0;
  for (int i = 0; i < 5; ++i) {
    const PictureHandle p = take(*camera);
    if (i > 0) {
      EXPECT_GT(p->sequence, sequence);
      EXPECT_EQ((p->exposure.start - last).ns, static_cast<std::int64_t>(p->sequence - sequence) * 5'000'000);
    }
    EXPECT_GE(p->exposure.start, before - Duration::from_ms(1));
    EXPECT_LE(p->exposure.middle(), Time::now());
    last = p->exposure.start;
    sequence = p->sequence;
  }
}

TEST_F(Synthetic, ALivePictureCanBeMadeAgainByItsNumber) {
  const std::string scene = "width=64,height=48,fps=100,exposure_ms=3,readout_ms=2,fingers=1,noise=2";
  const auto live = open(scene + ",live=1"), again = open(scene);
  for (int i = 0; i < 4; ++i) {
    const PictureHandle p = take(*live);
    PictureHandle q = take(*again);
    while (q->sequence < p->sequence) q = take(*again);
    ASSERT_EQ(q->sequence, p->sequence);
    EXPECT_TRUE(std::equal(p->planes[0], p->planes[0] + 3 * 64 * 48, q->planes[0])) << "picture " << p->sequence;
  }
}

TEST_F(Synthetic, FieldOfViewAndReadoutOfTheCommandLineCount) {
  CameraOptions options;
  options.spec = "synthetic:width=800,height=600";
  options.catalog = &catalog_;
  options.fov_rad = 35 * radian;
  options.readout = Duration::from_ms(12);
  const auto camera = open_camera(options);
  const PictureHandle p = take(*camera);
  EXPECT_NEAR(p->intrinsics.fx, 400 / std::tan(17.5 * radian), 1e-9);
  EXPECT_EQ(p->exposure.readout.ns, 12'000'000);
}

TEST_F(Synthetic, RefusesWhatItDoesNotKnowInWordsThatHelp) {
  const std::string unknown = error_of([&] { open("sped=3"); });
  EXPECT_NE(unknown.find("\"sped\""), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("exposure_ms"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("step_deg"), std::string::npos) << unknown;
  EXPECT_THROW(open("width"), UsageError);
  EXPECT_THROW(open("width=ten"), UsageError);
  EXPECT_THROW(open("width=640x"), UsageError);
  EXPECT_THROW(open("fov_deg=nan"), UsageError);
  EXPECT_THROW(open("script=dance"), UsageError);
  EXPECT_NE(error_of([&] { open("script=dance"); }).find("hands, side, link, "), std::string::npos);
  EXPECT_THROW(open("fingers=3"), UsageError);
  EXPECT_THROW(open("ids=3"), UsageError);
  EXPECT_THROW(open("ids=3+3"), UsageError);
  EXPECT_NE(error_of([&] { open("ids=3+77"); }).find("77"), std::string::npos);
  EXPECT_NE(error_of([&] { open("script=still,marker=8"); }).find("8"), std::string::npos);
  CameraOptions none;
  EXPECT_NE(error_of([&] { open_camera(none); }).find("--catalog"), std::string::npos);
  catalog_.markers.pop_back();
  EXPECT_NE(error_of([&] { open(""); }).find("2"), std::string::npos) << "two hands need two markers";
  EXPECT_EQ(error_of([&] { open("width=64,height=48,script=still"); }), "");
  none.spec = "webcam:0";
  EXPECT_THROW(open_camera(none), UsageError);
}

}  // namespace
}  // namespace onestroke::test
