// Two cameras as the command line asks for them.
#include "app/source.h"

#include "../core/error_of.h"
#include "../core/scratch_folder.h"
#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <thread>

namespace onestroke {
namespace {

using testing::HasSubstr;

const char* small = "synthetic:script=still,width=64,height=48,seed=3,noise=0";

/// A head that stands still somewhere.
struct Standing final : HeadTracker {
  std::optional<Pose> head_at(Time) const override { return T_world_head; }
  const Pose T_world_head{exp_so3({0, 0.4, 0}), {100, 0, 50}};
};

class SourceOfTwo : public testing::Test {
 protected:
  SourceOfTwo() {
    options.camera = small;
    options.second_camera = "synthetic";
    options.baseline_mm = 64;
  }

  PictureHandle first_picture(const HeadMount& mount = {}) {
    camera = open_worn_source(options, catalog, mount);
    PictureHandle picture;
    // Of cameras that are live one may be late, and the other's picture comes alone.
    while (camera->next(picture) == Camera::Status::busy || (camera->live() && !picture->second))
      std::this_thread::yield();
    return picture;
  }
  static void expect_rig(const Picture& pair, const Pose& T_first_second) {
    ASSERT_TRUE(pair.second);
    const Pose rig = inverse(pair.T_world_camera) * pair.second->T_world_camera;
    EXPECT_LT(norm(rig.translation - T_first_second.translation), 1e-9);
    EXPECT_LT(angle_between(rig.rotation, T_first_second.rotation), 1e-7);
  }
  /// The pictures show the stick where they say that they were taken.
  void expect_true(const Picture& pair) const {
    ASSERT_TRUE(pair.second);
    const auto left = camera->truth(pair), right = camera->truth(*pair.second);
    ASSERT_FALSE(left.empty());
    ASSERT_FALSE(right.empty());
    const Pose a = pair.T_world_camera * left[0].T_camera_marker;
    const Pose b = pair.second->T_world_camera * right[0].T_camera_marker;
    EXPECT_LT(norm(a.translation - b.translation), 1e-6);
    EXPECT_LT(angle_between(a.rotation, b.rotation), 1e-7);
  }

  const Catalog catalog = load_catalog(ONESTROKE_SOURCE_DIR "/assets/catalog.json");
  const Standing head;  // outlives the camera
  SourceOptions options;
  std::unique_ptr<Camera> camera;
};

TEST_F(SourceOfTwo, PlainSyntheticIsTheFirstSeenFromTheSecondsPlace) {
  const PictureHandle pair = first_picture();
  expect_rig(*pair, {{}, {64, 0, 0}});
  expect_true(*pair);
  EXPECT_EQ(pair->second->width, 64);
}

TEST_F(SourceOfTwo, ASyntheticOfItsOwnSitsWhereItsSettingsSay) {
  options.second_camera = std::string(small) + ",right_mm=64";
  const PictureHandle pair = first_picture();
  expect_rig(*pair, {{}, {64, 0, 0}});
  expect_true(*pair);
}

TEST_F(SourceOfTwo, LiveOnesShareTheirTime) {
  options.camera += ",live=1,fps=50";
  const PictureHandle pair = first_picture();
  ASSERT_TRUE(pair->second);
  EXPECT_EQ(pair->exposure.start, pair->second->exposure.start);
  expect_true(*pair);
}

TEST_F(SourceOfTwo, OnAHeadEachHasItsPlace) {
  options.camera += ",live=1,fps=50";
  const Pose T_head_camera{exp_so3({0.1, 0, 0}), {-32, -20, 60}};
  const PictureHandle pair = first_picture({&head, T_head_camera});
  expect_rig(*pair, {{}, {64, 0, 0}});
  expect_true(*pair);
  EXPECT_LT(norm(pair->T_world_camera.translation - (head.T_world_head * T_head_camera).translation), 1e-9);
}

TEST_F(SourceOfTwo, ARigTellsPlacesAndLenses) {
  const ScratchFolder folder;
  options.baseline_mm.reset();
  options.rig = folder.path() / "rig.yml";
  const auto matrix = [](const char* name, int rows, int columns, const char* data) {
    return std::string(name) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
           "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + data + " ]\n";
  };
  const std::string place = matrix("R", 3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.") + matrix("T", 3, 1, "-60., 0., 0.");
  const std::string lenses =
      matrix("M1", 3, 3, "50., 0., 31.5, 0., 50., 23.5, 0., 0., 1.") + matrix("D1", 1, 5, "0., 0., 0., 0., 0.") +
      matrix("M2", 3, 3, "55., 0., 31.5, 0., 55., 23.5, 0., 0., 1.") + matrix("D2", 1, 5, "0., 0., 0., 0., 0.");
  std::ofstream(options.rig) << "%YAML:1.0\n---\n" << place << lenses;
  const PictureHandle pair = first_picture();
  expect_rig(*pair, {{}, {60, 0, 0}});
  expect_true(*pair);
  EXPECT_EQ(pair->intrinsics.fx, 50);
  EXPECT_EQ(pair->second->intrinsics.fx, 55);
  options.fov_deg = 60;
  EXPECT_THAT(error_of([this] { open_source(options, catalog); }), HasSubstr("knows both lenses: leave --fov"));
}

TEST_F(SourceOfTwo, ADeviceAndARecordingAreNoPair) {
  options.second_camera = std::string(small) + ",live=1";
  EXPECT_THAT(error_of([this] { open_source(options, catalog); }), HasSubstr("give two of a kind"));
}

}  // namespace
}  // namespace onestroke
