// How two models differ is worked out while frames are drawn.
#include "app/difference_desk.h"

#include "../unit/core/scratch_folder.h"
#include "allocation/allocation_counter.h"
#include "core/error.h"
#include "golden/stage.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <set>
#include <thread>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using State = DifferenceDesk::State;
using testing::AllOf;
using testing::HasSubstr;

const fs::path assets = ONESTROKE_SOURCE_DIR "/assets";

class DeskStage : public golden::Stage {
 protected:
  fs::path catalog_file() const { return folder_ / "catalog.json"; }
  fs::path cache() const { return folder_ / "catalog.json.differences"; }

  /// Markers 1, 2, ... that carry these files of the folder; empty ones carry nothing.
  Catalog carrying(const std::vector<std::string>& models) const {
    Catalog catalog = load_catalog(assets / "catalog.json");
    const MarkerSpec any = catalog.markers.front();
    catalog.markers.clear();
    for (const std::string& model : models) {
      catalog.markers.push_back(any);
      catalog.markers.back().id = static_cast<int>(catalog.markers.size());
      catalog.markers.back().name = "part " + std::to_string(catalog.markers.size());
      catalog.markers.back().model = model;
      catalog.markers.back().import = {};
    }
    return catalog;
  }

  /// A box on the ground, mm.
  void write_box(const std::string& file, double x, double y, double z) const {
    std::ofstream out(folder_ / file);
    for (const double a : {0.0, x})
      for (const double b : {0.0, y})
        for (const double c : {0.0, z}) out << "v " << a << ' ' << b << ' ' << c << '\n';
    out << "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
  }
  /// Large enough that work on it is seen: a wavy sheet of n x n squares.
  void write_sheet(const std::string& file, int n, double wave) const {
    std::ofstream out(folder_ / file);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) out << "v " << i << ' ' << wave * std::sin(0.1 * i) << ' ' << j << '\n';
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = j * (n + 1) + i + 1;
        out << "f " << a << ' ' << a + n + 1 << ' ' << a + n + 2 << ' ' << a + 1 << '\n';
      }
  }

  /// Frame after frame, as the render loop does it, until it is no longer working.
  void settle(DifferenceDesk& desk, int base, int laid, Alignment alignment = Alignment::own_frames) {
    desk.request(base, laid, alignment);
    for (int frame = 0; frame < 20'000 && desk.state() == State::working; ++frame) {
      EXPECT_GE(desk.percent(), 0);
      EXPECT_LE(desk.percent(), 100);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      desk.request(base, laid, alignment);
    }
    EXPECT_NE(desk.state(), State::working);
  }
  golden::Picture draw_result(const DifferenceDesk::Result& result) {
    std::vector<ModelInstance> instances{
        {.model = result.map, .world_graphics_from_model = golden::placed(0, 0, -0.2F, 0.4F, 0.5F)}};
    if (result.veil)
      instances.push_back(
          {.model = *result.veil, .world_graphics_from_model = golden::placed(0, 0, -0.2F, 0.4F, 0.5F)});
    FrameScene scene;
    scene.instances = instances;
    scene.light = Light{};
    return draw(scene);
  }
  static double seconds(const std::function<void()>& what) {
    const auto begin = std::chrono::steady_clock::now();
    what();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  const ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(DeskStage, WorksOutWhatIsAskedForAndIsReady) {
  write_box("low.obj", 40, 20, 30);
  write_box("high.obj", 40, 25, 30);
  DifferenceDesk desk(carrying({"low.obj", "high.obj"}), catalog_file(), *renderer);
  EXPECT_EQ(desk.state(), State::none);
  EXPECT_EQ(desk.result(), nullptr);
  desk.request(1, 2, Alignment::own_frames);
  EXPECT_EQ(desk.state(), State::working);
  EXPECT_EQ(desk.result(), nullptr);
  settle(desk, 1, 2);
  ASSERT_EQ(desk.state(), State::ready) << desk.reason();
  const DifferenceStatistics& s = desk.result()->statistics;
  EXPECT_NEAR(s.most, 5, 1e-4);
  EXPECT_NEAR(s.volume_change(), 40 * 30 * 5, 0.1);
  EXPECT_NEAR(s.area_change(), 2 * (40 + 30) * 5, 0.01);
  EXPECT_EQ(desk.result()->base_from_laid, glm::dmat4(1));
  EXPECT_FALSE(desk.result()->veil) << "nothing of the lower one is missing";

  settle(desk, 2, 1);
  ASSERT_EQ(desk.state(), State::ready) << desk.reason();
  EXPECT_NEAR(desk.result()->statistics.volume_change(), -40 * 30 * 5, 0.1);
  EXPECT_TRUE(desk.result()->veil);
}

TEST_F(DeskStage, WhatItMakesCanBeDrawn) {
  write_box("low.obj", 40, 20, 30);
  write_box("high.obj", 40, 25, 30);
  DifferenceDesk desk(carrying({"low.obj", "high.obj"}), catalog_file(), *renderer);
  const golden::Picture empty = draw({});
  settle(desk, 2, 1);
  ASSERT_TRUE(desk.result() && desk.result()->veil);
  DifferenceDesk::Result map_alone = *desk.result();
  map_alone.veil.reset();
  const golden::Picture both = draw_result(*desk.result()), map = draw_result(map_alone);
  EXPECT_NE(map.rgb, empty.rgb);
  EXPECT_NE(both.rgb, map.rgb);
}

TEST_F(DeskStage, LaysModelsBestOnEachOther) {
  write_box("here.obj", 40, 20, 30);
  Catalog catalog = carrying({"here.obj", "there.obj"});
  std::ifstream in(folder_ / "here.obj");
  std::ofstream out(folder_ / "there.obj");
  for (std::string word; in >> word;)
    if (word == "v") {
      double x = 0, y = 0, z = 0;
      in >> x >> y >> z;
      out << "v " << x + 3 << ' ' << y - 1 << ' ' << z + 2 << '\n';
    } else {
      std::string rest;
      std::getline(in, rest);
      out << word << rest << '\n';
    }
  out.close();
  DifferenceDesk desk(catalog, catalog_file(), *renderer);
  settle(desk, 1, 2, Alignment::best_fit);
  ASSERT_EQ(desk.state(), State::ready) << desk.reason();
  EXPECT_NEAR(desk.result()->statistics.moved, std::sqrt(9.0 + 1 + 4), 1e-2);
  EXPECT_NEAR(desk.result()->base_from_laid[3].x, -0.003, 1e-5);
  EXPECT_LT(desk.result()->statistics.most, 1e-2);
  settle(desk, 1, 2);
  EXPECT_GT(desk.result()->statistics.rms, 1);
  EXPECT_EQ(desk.result()->statistics.moved, 0);
}

TEST_F(DeskStage, SaysWhyItCannot) {
  write_box("box.obj", 40, 20, 30);
  write_box("flat.obj", 0, 0, 0);
  std::ofstream(folder_ / "bad.stl") << "no model";
  DifferenceDesk desk(carrying({"box.obj", "", "none.obj", "bad.stl", "flat.obj"}), catalog_file(), *renderer);
  const auto reason = [&](int base, int laid) {
    settle(desk, base, laid);
    EXPECT_EQ(desk.state(), State::failed);
    EXPECT_EQ(desk.result(), nullptr);
    return desk.reason();
  };
  EXPECT_EQ(reason(1, 2), "part 2 carries no model");
  EXPECT_EQ(reason(3, 1), "none.obj: no such model file; check the path");
  EXPECT_THAT(reason(1, 4), AllOf(testing::StartsWith("bad.stl: "), HasSubstr("not an STL file")));
  EXPECT_THAT(reason(5, 1), HasSubstr("flat.obj: "));
  EXPECT_EQ(reason(1, 9), "a marker is not in the catalogue");
  settle(desk, 1, 1);
  EXPECT_EQ(desk.state(), State::ready) << "what failed leaves nothing behind";
  EXPECT_EQ(desk.reason(), "");
  write_box("none.obj", 40, 20, 25);
  settle(desk, 3, 1);
  EXPECT_EQ(desk.state(), State::ready) << "what failed is tried anew";
}

TEST_F(DeskStage, LeavesOffWhatIsNoLongerWanted) {
  write_sheet("large.obj", 220, 5);
  write_sheet("larger.obj", 220, 6);
  write_box("box.obj", 40, 20, 30);
  const Catalog catalog = carrying({"large.obj", "larger.obj", "box.obj"});
  DifferenceDesk desk(catalog, catalog_file(), *renderer);
  const double whole = seconds([&] { settle(desk, 1, 2); });
  ASSERT_EQ(desk.state(), State::ready);
  fs::remove_all(cache());
  DifferenceDesk other(catalog, catalog_file(), *renderer);
  other.request(1, 2, Alignment::own_frames);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(other.state(), State::working);
  const double short_of_it = seconds([&] { settle(other, 3, 3); });
  EXPECT_EQ(other.state(), State::ready);
  EXPECT_LT(short_of_it, whole / 2);
  ASSERT_TRUE(fs::exists(cache()));
  EXPECT_EQ(std::distance(fs::directory_iterator(cache()), {}), 1) << "of the boxes alone";
  other.request(1, 2, Alignment::own_frames);
  EXPECT_EQ(other.state(), State::working) << "it was not finished";
}

TEST_F(DeskStage, LeavingEarlyDoesNotWaitForTheEnd) {
  write_sheet("large.obj", 220, 5);
  write_sheet("larger.obj", 220, 6);
  const Catalog catalog = carrying({"large.obj", "larger.obj"});
  const double left = seconds([&] {
    DifferenceDesk desk(catalog, catalog_file(), *renderer);
    desk.request(1, 2, Alignment::best_fit);
  });
  DifferenceDesk desk(catalog, catalog_file(), *renderer);
  EXPECT_LT(left, seconds([&] { settle(desk, 1, 2, Alignment::best_fit); }) / 2);
}

TEST_F(DeskStage, TakesWhatWasFoundOutBefore) {
  write_sheet("one.obj", 200, 5);
  write_sheet("two.obj", 200, 6);
  const Catalog catalog = carrying({"one.obj", "two.obj"});
  DifferenceStatistics first;
  {
    DifferenceDesk desk(catalog, catalog_file(), *renderer);
    settle(desk, 1, 2);
    ASSERT_EQ(desk.state(), State::ready);
    first = desk.result()->statistics;
  }
  ASSERT_TRUE(fs::exists(cache()));
  const fs::path file = fs::directory_iterator(cache())->path();
  const auto written = fs::last_write_time(file);
  DifferenceDesk again(catalog, catalog_file(), *renderer);
  settle(again, 1, 2);
  EXPECT_EQ(again.result()->statistics.rms, first.rms);
  EXPECT_EQ(fs::last_write_time(file), written) << "it was not measured again";
  // A model that was changed is another one.
  write_sheet("two.obj", 200, 7);
  DifferenceDesk changed(catalog, catalog_file(), *renderer);
  settle(changed, 1, 2);
  EXPECT_GT(changed.result()->statistics.rms, 1.2 * first.rms);
}

TEST_F(DeskStage, KeepsTheLastFewAndLetsTheOldestGo) {
  std::vector<std::string> models;
  for (int i = 0; i < 6; ++i) {
    models.push_back("box" + std::to_string(i) + ".obj");
    write_box(models.back(), 40, 20 + i, 30);
  }
  DifferenceDesk desk(carrying(models), catalog_file(), *renderer);
  std::set<ModelHandle> maps;
  for (int laid = 1; laid <= 6; ++laid) {
    settle(desk, 1, laid);
    ASSERT_EQ(desk.state(), State::ready);
    EXPECT_NEAR(desk.result()->statistics.most, laid - 1, 1e-4);
    maps.insert(desk.result()->map);
    draw_result(*desk.result());
  }
  EXPECT_EQ(maps.size(), DifferenceDesk::most_results) << "handles of those that went are given again";
  desk.request(1, 3, Alignment::own_frames);
  EXPECT_EQ(desk.state(), State::ready) << "the oldest of four";
  EXPECT_NEAR(desk.result()->statistics.most, 2, 1e-4);
  desk.request(1, 2, Alignment::own_frames);
  EXPECT_EQ(desk.state(), State::working) << "gone";
}

TEST_F(DeskStage, BeginsAnewWithANewRenderer) {
  write_box("low.obj", 40, 20, 30);
  write_box("high.obj", 40, 25, 30);
  const Catalog catalog = carrying({"low.obj", "high.obj"});
  std::optional<DifferenceDesk> desk(std::in_place, catalog, catalog_file(), *renderer);
  settle(*desk, 2, 1);
  const golden::Picture before = draw_result(*desk->result());
  // One is ready and not yet taken in, one is being worked on.
  desk->request(1, 2, Alignment::own_frames);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  desk.reset();
  *renderer = Renderer(*gpu);
  desk.emplace(catalog, catalog_file(), *renderer);
  EXPECT_EQ(desk->state(), State::none);
  settle(*desk, 2, 1);
  EXPECT_EQ(draw_result(*desk->result()).rgb, before.rgb);
}

TEST_F(DeskStage, AsksNoMemoryOfAFrame) {
  write_sheet("one.obj", 100, 5);
  write_sheet("two.obj", 100, 6);
  DifferenceDesk desk(carrying({"one.obj", "two.obj"}), catalog_file(), *renderer);
  desk.request(1, 2, Alignment::own_frames);
  long before = test::allocations_of_this_thread();
  int waiting = 0;
  for (; desk.state() == State::working && desk.percent() < 50; ++waiting) desk.request(1, 2, Alignment::own_frames);
  EXPECT_EQ(test::allocations_of_this_thread(), before) << "while it works";
  EXPECT_GT(waiting, 0);
  settle(desk, 1, 2);
  settle(desk, 2, 1);
  before = test::allocations_of_this_thread();
  for (int frame = 0; frame < 100; ++frame) {
    desk.request(1, 2, Alignment::own_frames);
    EXPECT_TRUE(desk.result());
    desk.request(2, 1, Alignment::own_frames);
    EXPECT_TRUE(desk.result());
  }
  EXPECT_EQ(test::allocations_of_this_thread(), before) << "once ready";
}

}  // namespace
}  // namespace onestroke
