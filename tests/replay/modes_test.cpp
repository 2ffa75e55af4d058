// What the wearer sees of each way of comparing, and what a snapshot keeps of it.
#include "../unit/core/scratch_folder.h"
#include "app/snapshot_numbers.h"
#include "app/snapshots.h"
#include "app/two_hands.h"
#include "golden/stage.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

const fs::path assets = ONESTROKE_SOURCE_DIR "/assets";
constexpr double frame_ms = 20;

/// A copy of the demo's catalogue and models, beside which may be written.
class OwnAssets {
 public:
  OwnAssets() {
    for (const char* file : {"catalog.json", "bracket_v1.glb", "bracket_v2.glb"})
      fs::copy_file(assets / file, folder() / file);
  }
  const fs::path& folder() const { return scratch_.path(); }

 private:
  ScratchFolder scratch_;
};

class Modes : public golden::Stage {
 protected:
  Modes() {
    shelf.wait();
    hands.toggle_words();
  }

  MarkerObservation observed(int id, const char* name, const Pose& T) const {
    MarkerObservation m;
    m.id = id;
    std::snprintf(m.name.data(), m.name.size(), "%s", name);
    m.state = MarkerState::measured;
    m.T_camera_marker = T;
    return m;
  }

  /// So long, with the sticks where they are.
  const FrameScene& run(double ms) {
    const FrameScene* scene = nullptr;
    for (const double end = now_ + ms; now_ < end; now_ += frame_ms) {
      record.markers[0] = observed(1, "bracket v1", left);
      record.markers[1] = observed(2, "bracket v2", right);
      record.marker_count = 2;
      scene = &hands.update(record, Time{} + Duration::from_ms(now_), {&view, 1}, "");
    }
    scene_ = *scene;
    scene_.passthrough_segments = {};
    return scene_;
  }
  void expect_picture(const std::string& name, const FrameScene& scene) {
    expect_golden(name, draw(scene, {&view, 1}), {.level = 12, .pixels = 120});
  }

  const OwnAssets own;
  const Catalog catalog = load_catalog(own.folder() / "catalog.json");
  ModelShelf shelf{catalog, own.folder(), *renderer};
  DifferenceDesk desk{catalog, own.folder() / "catalog.json", *renderer};
  TwoHands hands{shelf, &desk, {.left_handed = false, .wait_for_differences = true}};
  FrameRecord record;
  Pose left{from_euler_xyz(0.3, 0.6, 0), {-75, 25, 330}}, right{from_euler_xyz(0.3, 0.35, 0), {20, 25, 330}};
  const View view{.T_world_view = {},
                  .fov = fov_of(Intrinsics::from_fov(width, height, fov), width, height),
                  .viewport = {0, 0, width, height}};

 private:
  FrameScene scene_;
  double now_ = 0;
};

TEST_F(Modes, SideBySide) {
  expect_picture("mode_side", run(500));
}

TEST_F(Modes, OverlayIsAMapOfTheDistance) {
  run(300);
  hands.press('o');
  run(400);
  ASSERT_NE(hands.difference(), nullptr);
  EXPECT_GT(hands.difference()->statistics.rms, 1);
  EXPECT_TRUE(hands.difference()->statistics.laid.closed);
  expect_picture("mode_overlay", run(200));
}

TEST_F(Modes, TheBestFitMovesTheModelThatIsLaid) {
  run(300);
  hands.press('o');
  run(400);
  const Similarity before = hands.comparison()[Hand::right].world_from_marker;
  hands.press('b');
  run(400);
  ASSERT_EQ(hands.comparison().mode.tool, Tool::fitted);
  ASSERT_NE(hands.difference(), nullptr);
  const double moved = hands.difference()->statistics.moved;
  EXPECT_GT(moved, 0.1);
  // Of the model's middle, which is that of its box.
  const Vec3 middle = shelf.find(2)->placement.pivot;
  const Vec3 by = hands.comparison()[Hand::right].world_from_marker * middle - before * middle;
  EXPECT_NEAR(norm(by), moved, 1e-3 * moved);
}

TEST_F(Modes, ASectionHasFilledFaces) {
  run(300);
  hands.press('c');
  right = {from_euler_xyz(0, 0.25, 0), {60, 20, 284}};
  expect_picture("mode_section", run(600));
}

TEST_F(Modes, LinkedModelsAreCutAlike) {
  run(300);
  hands.press('l');
  run(300);
  hands.press('c');
  right = {from_euler_xyz(0, 0.25, 0), {60, 60, 284}};
  expect_picture("mode_section_linked", run(600));
}

TEST_F(Modes, MeasuredPointsAreJoined) {
  run(300);
  hands.press('m');
  run(100);
  for (const Vec3 p : {Vec3{10, -8, -20}, {66, -8, -20}, {66, -54, 10}}) {
    right.translation = left * p - rotate(right.rotation, {0, -72, 0});
    run(1000);
  }
  ASSERT_EQ(hands.comparison().measure.count, 3);
  expect_picture("mode_measure", run(200));
}

TEST_F(Modes, ACardTellsOfTheModel) {
  run(300);
  right.translation = {-110, 30, 260};
  left.translation = {60, -25, 400};
  expect_picture("mode_card", run(900));
}

TEST_F(Modes, WhatIsAboutToHappenIsOffered) {
  run(300);
  right.translation = left * Vec3{} - rotate(right.rotation, {0, -72, 0}) + Vec3{4, 4, 0};
  expect_picture("mode_offer", run(500));
}

TEST_F(Modes, TheMenuHangsAboveTheHands) {
  run(300);
  hands.press('n');
  run(200);
  const MenuView& menu = hands.comparison().menu;
  right.translation = menu.T_world_menu * MenuView::place_of(4) - rotate(right.rotation, {0, -72, 0});
  expect_picture("mode_menu", run(600));
}

TEST_F(Modes, ASnapshotIsAPictureAndItsNumbers) {
  const fs::path folder = own.folder() / "kept";
  Snapshots snapshots(folder);
  run(300);
  hands.press('o');
  const FrameScene& scene = run(500);
  const DifferenceStatistics& difference = hands.difference()->statistics;
  for (int i = 0; i < 2; ++i) {
    snapshots.take(*gpu, *renderer, scene, view, snapshot_numbers(catalog, record, hands.comparison(), &difference));
    snapshots.wait();
    EXPECT_NE(snapshots.notice().find("Saved "), std::string_view::npos) << snapshots.notice();
  }
  EXPECT_EQ(snapshots.saved(), 2);
  const golden::Picture kept = golden::read_png(folder / "snapshot_001.png");
  const golden::Picture drawn = draw(scene, {&view, 1});
  EXPECT_TRUE(golden::compare(drawn, kept, {.level = 1}).same);
  EXPECT_TRUE(fs::exists(folder / "snapshot_002.png"));
  const nlohmann::json numbers = nlohmann::json::parse(std::ifstream(folder / "snapshot_001.json"));
  EXPECT_EQ(numbers.at("mode").at("tool"), "overlay");
  EXPECT_EQ(numbers.at("left").at("model").at("version"), "v1");
  EXPECT_EQ(numbers.at("right").at("model").at("notes").at("material"), "aluminium 6061-T6");
  EXPECT_DOUBLE_EQ(numbers.at("difference").at("rms_mm").get<double>(), difference.rms);
  EXPECT_DOUBLE_EQ(numbers.at("right_to_left").at("distance_mm").get<double>(),
                   norm(left.translation - right.translation));
  EXPECT_EQ(numbers.at("left").at("stick").at("t").at(0).get<double>(), left.translation.x);
}

TEST_F(Modes, ASnapshotThatCannotBeSavedSaysSo) {
  const fs::path file = own.folder() / "in_the_way";
  std::ofstream(file) << "not a folder";
  Snapshots snapshots(file);
  snapshots.take(*gpu, *renderer, run(100), view, "{}\n");
  snapshots.wait();
  EXPECT_EQ(snapshots.saved(), 0);
  EXPECT_NE(snapshots.notice().find("Snapshot not saved: the folder " + file.string()), std::string_view::npos)
      << snapshots.notice();
}

}  // namespace
}  // namespace onestroke
