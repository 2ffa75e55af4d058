#include "app/head_mount.h"

#include "../core/error_of.h"
#include "core/error.h"
#include "session_example.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace onestroke {
namespace {

using testing::HasSubstr;

/// With a place for the user's own calibrations, and assets, in a folder of the test's own.
class HeadMount : public test::FolderTest {
 protected:
  void SetUp() override {
    test::FolderTest::SetUp();
    setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
    setenv("ONESTROKE_ASSETS", folder.c_str(), 1);
  }
  void TearDown() override {
    unsetenv("XDG_CONFIG_HOME");
    unsetenv("ONESTROKE_ASSETS");
    test::FolderTest::TearDown();
  }
  static MountReport report(double x, const std::string& headset = "Index", const std::string& camera = "libcamera:0") {
    MountReport report{.headset = headset, .camera = camera, .date = "2026-11-26T18:00:00Z"};
    report.calibration.T_head_camera = {exp_so3({0.1, 1.0 / 3, -0.2}), {x, -20, 1.0 / 7}};
    return report;
  }
  void ship(const std::string& text) const { std::ofstream(folder / "headsets.json") << text; }
};

TEST_F(HeadMount, IsWrittenAndReadBackExactly) {
  const MountReport wrote = report(31.25);
  write_mount(folder / "deep/head.json", wrote);
  const auto found = find_mount("another", "another", folder / "deep/head.json");
  ASSERT_TRUE(found);
  EXPECT_LT(norm(found->T_head_camera.translation - wrote.calibration.T_head_camera.translation), 1e-12);
  EXPECT_LT(angle_between(found->T_head_camera.rotation, wrote.calibration.T_head_camera.rotation), 1e-12);
  EXPECT_THAT(found->from, HasSubstr("calibrated 2026-11-26, "));
}

TEST_F(HeadMount, OwnCalibrationsAreKeptByHeadsetAndCamera) {
  EXPECT_EQ(mounts_file(), folder / "onestroke/headsets.json");
  EXPECT_FALSE(find_mount("Index", "libcamera:0"));
  keep_mount(report(1));
  keep_mount(report(2, "Quest"));
  keep_mount(report(3, "Index", "libcamera:1"));
  keep_mount(report(4));
  EXPECT_EQ(find_mount("Index", "libcamera:0")->T_head_camera.translation.x, 4);
  EXPECT_EQ(find_mount("Quest", "libcamera:0")->T_head_camera.translation.x, 2);
  EXPECT_EQ(find_mount("Index", "libcamera:1")->T_head_camera.translation.x, 3);
  EXPECT_FALSE(find_mount("Index", "libcamera:2"));
  EXPECT_FALSE(find_mount("Ind", "libcamera:0"));
}

TEST_F(HeadMount, OwnOnesGoBeforeThoseThatAreShipped) {
  ship(R"({"headsets": [{"headset": "In*x", "camera": "*", "T_head_camera": [1,0,0,0,7,8,9], "note": "a guess"}]})");
  EXPECT_EQ(find_mount("Index", "libcamera:0")->T_head_camera.translation.y, 8);
  EXPECT_THAT(find_mount("Inx", "x")->from, HasSubstr("a guess"));
  EXPECT_FALSE(find_mount("Indexes", "x"));
  keep_mount(report(1));
  EXPECT_EQ(find_mount("Index", "libcamera:0")->T_head_camera.translation.x, 1);
}

TEST_F(HeadMount, TheSyntheticCameraIsOneWhateverItShows) {
  keep_mount(report(1, "Index", "synthetic:live=1,noise=2"));
  EXPECT_TRUE(find_mount("Index", "synthetic"));
}

TEST_F(HeadMount, WhatIsNotSoundIsSaid) {
  EXPECT_THAT(error_of([&] { find_mount("a", "b", folder / "none.json"); }), HasSubstr("none.json is not there"));
  for (const char* bad : {"{", "[]", "{}", R"({"headsets": [{"headset": "a", "camera": "*"}]})",
                          R"({"headsets": [{"headset": "a", "camera": "*", "T_head_camera": [1,0,0]}]})",
                          R"({"headsets": [{"headset": "a", "camera": "*", "T_head_camera": [9,0,0,0,1,1,1]}]})"}) {
    ship(bad);
    EXPECT_THAT(error_of([&] { find_mount("a", "b"); }), HasSubstr("headsets.json says nothing of a headset's camera"))
        << bad;
  }
}

TEST(ShippedMounts, AreSound) {
  setenv("XDG_CONFIG_HOME", "/nowhere", 1);
  const auto found = find_mount("Monado: Simulated HMD", "synthetic:live=1");
  unsetenv("XDG_CONFIG_HOME");
  ASSERT_TRUE(found);
  EXPECT_EQ(norm(found->T_head_camera.translation), 0);
}

}  // namespace
}  // namespace onestroke
