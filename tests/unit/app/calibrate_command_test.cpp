// `onestroke calibrate head` from a session's log, and what it gathers.
#include "app/calibrate_command.h"

#include "../core/error_of.h"
#include "app/clock_sights.h"
#include "app/head_mount.h"
#include "app/head_pose_file.h"
#include "app/head_sights.h"
#include "app/session_json.h"
#include "app/source.h"
#include "core/error.h"
#include "session_example.h"
#include "tracking/clock_calibration.h"
#include "tracking/tracker.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <numbers>
#include <sstream>

namespace onestroke {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;
const Pose true_T_head_camera{exp_so3({0.2, -0.05, 0.02}), {30, -40, 60}},
    T_world_marker{exp_so3({0.5, 0.9, 0}), {40, 60, 480}};

/// What a session was shown with.
const Pose guess_T_head_camera{exp_so3({0, 0.1, 0}), {0, 0, 50}};

Pose T_world_head_at(double t, double nod) {
  return {exp_so3({nod * degree * std::sin(1.1 * t), 20 * degree * std::sin(0.7 * t), 0}),
          {40 * std::sin(0.9 * t), 10 * std::sin(1.7 * t), 0}};
}

/// A head that nods by `nod` degrees, and looks left and right, 30 pictures a second.
FrameRecord record_at(int i, double nod) {
  const double t = i / 30.0;
  const Pose T_world_head = T_world_head_at(t, nod);
  FrameRecord record;
  record.sequence = static_cast<std::uint64_t>(i);
  record.time = Time{} + Duration::from_seconds(t);
  record.T_world_camera = T_world_head;
  record.marker_count = 1;
  MarkerObservation& m = record.markers[0];
  m.id = 3;
  m.state = MarkerState::measured;
  m.T_camera_marker = inverse(T_world_head * true_T_head_camera) * T_world_marker;
  for (std::size_t k = 0; k < 6; ++k) m.covariance[7 * k] = k < 3 ? 1e-8 : 1e-4;
  return record;
}

class CalibrateCommand : public test::FolderTest {
 protected:
  void SetUp() override {
    test::FolderTest::SetUp();
    setenv("XDG_CONFIG_HOME", file.parent_path().c_str(), 1);
  }
  void TearDown() override {
    unsetenv("XDG_CONFIG_HOME");
    test::FolderTest::TearDown();
  }
  void log_session(double nod) const {
    std::ofstream out(file);
    out << session_line({.program = "0.1.0",
                         .camera = "libcamera:0",
                         .catalog = "/c.json",
                         .rate = 30,
                         .T_head_camera = guess_T_head_camera})
        << '\n';
    SessionFrame frame;
    frame.picture = true;
    const std::string lens = session_text(PictureLens{640, 480, Intrinsics::from_fov(640, 480, 1)});
    for (int i = 0; i < 600; ++i) {
      FrameRecord record = record_at(i, nod);
      record.T_world_camera = record.T_world_camera * guess_T_head_camera;
      out << session_line(frame, {.record = session_text(record), .lens = lens, .second = {}}) << '\n';
    }
  }
  int calibrate(const std::string& headset, std::ostream& out) const {
    CalibrateOptions options;
    options.output = output();
    options.replay = file;
    options.headset = headset;
    return calibrate_command(options, out);
  }
  std::filesystem::path output() const { return file.parent_path() / "head.json"; }
};

TEST_F(CalibrateCommand, ASessionTellsHowItsHeadsetCarriedTheCamera) {
  log_session(15);
  std::ostringstream out;
  EXPECT_EQ(calibrate("Index", out), 0);
  for (const char* words : {"the camera in the head", "30.00   -40.00    60.00 mm",
                            "degrees about two axes; 0 left out", "px", "wrote ", "kept in "})
    EXPECT_THAT(out.str(), HasSubstr(words));
  for (const auto& found : {find_mount("", "", output()), find_mount("Index", "libcamera:0")}) {
    ASSERT_TRUE(found);
    EXPECT_LT(norm(found->T_head_camera.translation - true_T_head_camera.translation), 0.01);
    EXPECT_LT(angle_between(found->T_head_camera.rotation, true_T_head_camera.rotation), 1e-4);
  }
}

TEST_F(CalibrateCommand, AHeadThatOnlyLooksLeftAndRightIsNotEnough) {
  log_session(0);
  std::ostringstream out;
  EXPECT_THAT(error_of([&] { calibrate("", out); }), HasSubstr("by 0 degrees about any other"));
  EXPECT_FALSE(std::filesystem::exists(output()));
}

TEST_F(CalibrateCommand, ASessionWithoutAHeadIsRefused) {
  std::ofstream(file) << session_line({.program = "0.1.0", .camera = "synthetic", .catalog = "/c.json", .rate = 30})
                      << '\n';
  std::ostringstream out;
  EXPECT_THAT(error_of([&] { calibrate("", out); }), HasSubstr("has no poses of a head"));
}

/// A head that moves as above, before pictures.
class Wearer final : public HeadTracker {
 public:
  std::optional<Pose> head_at(Time time) const override {
    return T_world_head_at(static_cast<double>(time.ns) * 1e-9, 12);
  }
};

// All that there is but the headset: pictures of a stick that stands still, drawn as a camera on the head sees them.
TEST(CalibratedFromPictures, TheCameraIsFoundWhereItSits) {
  const Catalog catalog = load_catalog(ONESTROKE_SOURCE_DIR "/assets/catalog.json");
  const Wearer wearer;
  const Pose T_head_camera{exp_so3({0.1, -0.05, 0.02}), {30, -20, 40}};
  SourceOptions pictures;
  pictures.camera = "synthetic:script=still,width=640,height=480,fps=6,seconds=20";
  const auto camera = open_source(pictures, catalog, {.head = &wearer, .T_head_camera = T_head_camera});
  Tracker tracker(catalog);
  const auto record = std::make_unique<FrameRecord>();
  HeadSights sights;
  double focal_px = 0;
  for (PictureHandle picture; camera->next(picture) == Camera::Status::ok;) {
    tracker.process(*picture, *record);
    sights.add(*record, *wearer.head_at(picture->exposure.middle()));
    focal_px = picture->intrinsics.fx;
  }
  const HeadCalibration found = calibrate_head(sights.sights(), focal_px);
  const Vec3 off = found.T_head_camera.translation - T_head_camera.translation;
  const double turned = angle_between(found.T_head_camera.rotation, T_head_camera.rotation) / degree;
  std::cout << "off by " << norm(off) << " mm and " << turned << " degrees, deviations " << norm(found.deviation_mm)
            << " mm and " << norm(found.deviation_deg) << " degrees; residuals " << found.residuals.rms_mm << " mm, "
            << found.residuals.rms_deg << " degrees, " << found.residuals.rms_px << " px rms of " << found.used
            << " sights, " << found.outliers << " left out\n";
  EXPECT_GT(found.used, 30u);
  EXPECT_LT(norm(off), 1);
  EXPECT_LT(turned, 0.1);
  EXPECT_LT(norm(off), 4 * norm(found.deviation_mm));
  EXPECT_LT(turned, 4 * norm(found.deviation_deg));
}

/// A head that is shaken and nods.
class Shaker final : public HeadTracker {
 public:
  std::optional<Pose> head_at(Time time) const override {
    const double t = static_cast<double>(time.ns) * 1e-9;
    return Pose{exp_so3({5 * degree * std::sin(4.1 * t), 9 * degree * std::sin(5.3 * t), 0}), {}};
  }
};

// Pictures whose times say that they are older than they are.
TEST(CalibratedFromPictures, TheClockIsFoundToBeLate) {
  const Catalog catalog = load_catalog(ONESTROKE_SOURCE_DIR "/assets/catalog.json");
  const Shaker shaker;
  SourceOptions pictures;
  pictures.camera = "synthetic:script=still,width=640,height=480,fps=30,seconds=8,exposure_ms=4,readout_ms=12";
  const auto camera = open_source(pictures, catalog, {.head = &shaker, .T_head_camera = {exp_so3({0.1, 0, 0}), {}}});
  Tracker tracker(catalog);
  const auto record = std::make_unique<FrameRecord>();
  ClockSights sights;
  const Duration late = Duration::from_ms(23);
  for (PictureHandle picture; camera->next(picture) == Camera::Status::ok;) {
    picture.set_T_world_camera({});
    tracker.process(*picture, *record);
    record->time = record->time - late;
    sights.add(*record, *shaker.head_at(record->time));
  }
  const ClockOffset found = find_clock_offset(sights.sights());
  std::cout << "off by " << (found.offset - late).ms() << " ms, deviation " << found.deviation.ms() << " ms, "
            << found.residual_deg << " degrees left, " << found.used << " pictures\n";
  EXPECT_LT(std::abs((found.offset - late).ms()), 0.5);
  EXPECT_LT(std::abs((found.offset - late).ms()), 4 * found.deviation.ms());
  EXPECT_GT(sights.progress(), 0.5);
}

TEST(HeadSights, TakesWhatIsMeasuredSlowAndNew) {
  HeadSights sights;
  EXPECT_EQ(sights.advice(), "look at a marker that lies still");
  FrameRecord record = record_at(0, 15);
  record.markers[0].state = MarkerState::predicted;
  sights.add(record, record.T_world_camera);
  EXPECT_EQ(sights.seen(), 0u);
  record = record_at(0, 15);
  for (int again = 0; again < 5; ++again) sights.add(record, record.T_world_camera);
  EXPECT_EQ(sights.seen(), 5u);
  EXPECT_EQ(sights.sights().size(), 1u) << "the head stood as before";
  record.time = record.time + Duration::from_ms(30);
  sights.add(record, record.T_world_camera * Pose{exp_so3({0, 10 * degree, 0}), {}});
  EXPECT_EQ(sights.sights().size(), 1u) << "it turns by 330 degrees a second";
  record = record_at(0, 15);
  record.time = Time{} + Duration::from_seconds(9);
  record.markers[0].covariance[0] = 1;
  sights.add(record, {exp_so3({0, 20 * degree, 0}), {}});
  EXPECT_EQ(sights.sights().size(), 1u) << "a radian of uncertainty";
}

TEST(HeadSights, ProgressEndsWhenTheHeadHasTurnedEnough) {
  HeadSights sights;
  double before = 0;
  int i = 0;
  for (; i < 3000 && !sights.enough(); ++i) {
    const FrameRecord record = record_at(i, 15);
    sights.add(record, record.T_world_camera);
    EXPECT_GE(sights.progress(), before);
    before = sights.progress();
  }
  EXPECT_TRUE(sights.enough());
  EXPECT_GT(sights.turn().second_deg, HeadSights::wanted_second_deg);
  HeadSights level;
  for (i = 0; i < 3000; ++i) level.add(record_at(i, 0), record_at(i, 0).T_world_camera);
  EXPECT_LT(level.progress(), 0.1);
  EXPECT_EQ(level.advice(), "now nod, and tilt your head");
}

class HeadPoseFileTest : public test::FolderTest {
 protected:
  HeadPoseFile read(const std::string& text) const {
    std::ofstream(file) << text;
    return HeadPoseFile(file);
  }
};

TEST_F(HeadPoseFileTest, TellsPosesByTimeAndByName) {
  const HeadPoseFile heads = read(R"({"time_ns": 0, "T_world_head": [1,0,0,0,0,0,0]}
{"time_ns": 100000000, "T_world_head": [1,0,0,0,10,0,0]}
{"time_ns": 900000000, "T_world_head": [1,0,0,0,90,0,0]}
{"image": "a.png", "T_world_head": [1,0,0,0,5,5,5]}
)");
  Picture picture;
  picture.exposure.start = {75'000'000};
  EXPECT_NEAR(heads.head_of(picture)->translation.x, 7.5, 1e-9);
  picture.exposure.start = {500'000'000};
  EXPECT_FALSE(heads.head_of(picture)) << "too far from either";
  picture.exposure.start = {1'000'000'000};
  EXPECT_FALSE(heads.head_of(picture));
  picture.source = "a.png";
  EXPECT_EQ(heads.head_of(picture)->translation.z, 5);
}

TEST_F(HeadPoseFileTest, WhatIsNoPoseIsSaidWithItsLine) {
  EXPECT_THAT(error_of([&] { read("{\"time_ns\": 0, \"T_world_head\": [1,0,0,0,0,0,0]}\n{}\n"); }),
              HasSubstr("line 2, is no pose of a head"));
  EXPECT_THAT(error_of([&] { read("\n"); }), HasSubstr("has no pose of a head"));
  EXPECT_THAT(error_of([&] { HeadPoseFile("/nowhere/at/all"); }), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace onestroke
