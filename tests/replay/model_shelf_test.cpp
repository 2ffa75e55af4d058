// Models come while frames are drawn.
#include "app/model_shelf.h"

#include "../unit/core/scratch_folder.h"
#include "app/two_hands.h"
#include "core/error.h"
#include "golden/stage.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

namespace onestroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const fs::path assets = ONESTROKE_SOURCE_DIR "/assets";

class ShelfStage : public golden::Stage {
 protected:
  /// Large enough that its loading is seen: a wavy sheet of n x n squares.
  void write_sheet(const std::string& file, int n) const {
    std::ofstream out(folder_ / file);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) out << "v " << i << ' ' << 5 * std::sin(0.1 * i) << ' ' << j << '\n';
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = j * (n + 1) + i + 1;
        out << "f " << a << ' ' << a + n + 1 << ' ' << a + n + 2 << ' ' << a + 1 << '\n';
      }
  }

  Catalog carrying(const std::string& model, ModelImport import = {}) const {
    Catalog catalog = load_catalog(assets / "catalog.json");
    catalog.markers[1].model = {};
    catalog.markers[1].import = {};
    catalog.markers[0].model = model;
    catalog.markers[0].import = import;
    return catalog;
  }

  FrameRecord one_stick() const {
    FrameRecord record;
    record.marker_count = 1;
    record.markers[0].id = 1;
    record.markers[0].state = MarkerState::measured;
    record.markers[0].T_camera_marker = {{}, {-30, 30, 400}};
    return record;
  }

  /// Until nothing is said of the model's loading, as the render loop does it.
  void draw_until_settled(ModelShelf& shelf, TwoHands& hands) {
    const FrameRecord record = one_stick();
    for (int frame = 0; frame < 5000 && loading(shelf); ++frame) {
      shelf.update();
      draw(hands.update(record, Time{} + Duration::from_ms(10.0 * frame), {}, ""));
    }
    EXPECT_FALSE(loading(shelf));
  }
  static bool loading(const ModelShelf& shelf) { return words(shelf).starts_with("loading"); }
  static std::string words(const ModelShelf& shelf) { return std::string(shelf.carried()[0].words.view()); }

  const ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(ShelfStage, AStickShowsItsAxesUntilItsModelIsThere) {
  write_sheet("sheet.obj", 120);
  ModelShelf shelf(carrying("sheet.obj", {.fit = 60}), folder_, *renderer);
  TwoHands hands(shelf);
  ASSERT_THAT(words(shelf), testing::MatchesRegex("loading [0-9]+ %"));
  EXPECT_FALSE(shelf.find(1)->model);
  const FrameRecord record = one_stick();
  hands.update(record, Time{}, {}, "");
  EXPECT_EQ(hands.update(record, Time{} + Duration::from_ms(500), {}, "").lines.size(), 3U) << "the axes";
  EXPECT_THAT(std::string(hands.comparison()[Hand::left].label.view()) +
                  std::string(hands.comparison()[Hand::right].label.view()),
              HasSubstr(" · loading "));
  draw_until_settled(shelf, hands);
  ASSERT_TRUE(shelf.find(1)->model);
  EXPECT_EQ(words(shelf), "sheet");
  EXPECT_EQ(shelf.carried()[0].pivot, shelf.find(1)->placement.pivot);
  const FrameScene& scene = hands.update(record, Time{} + Duration::from_seconds(60), {}, "");
  EXPECT_EQ(scene.lines.size(), 0U);
  EXPECT_EQ(scene.instances.size(), 2U) << "the rod and the model";
}

TEST_F(ShelfStage, AModelThatCannotBeLoadedHasItsReasonInTheLabel) {
  std::ofstream(folder_ / "bad.stl") << "no model";
  ModelShelf shelf(carrying("bad.stl"), folder_, *renderer);
  TwoHands hands(shelf);
  draw_until_settled(shelf, hands);
  EXPECT_FALSE(shelf.find(1)->model);
  EXPECT_THAT(words(shelf), AllOf(testing::StartsWith("bad.stl: "), HasSubstr("not an STL file")));
}

TEST_F(ShelfStage, WaitingForAllSaysHowFarTheyAreAndThrowsWhereOneFails) {
  write_sheet("sheet.obj", 100);
  ModelShelf shelf(carrying("sheet.obj"), folder_, *renderer);
  int said = 0;
  shelf.wait([&](const std::string& line) {
    EXPECT_THAT(line, testing::MatchesRegex("loading models, [0-9]+ %"));
    ++said;
  });
  EXPECT_GT(said, 0);
  EXPECT_TRUE(shelf.find(1)->model);
  ModelShelf failing(carrying("none.obj"), folder_, *renderer);
  try {
    failing.wait();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("marker 1 (bracket v1): "), HasSubstr("none.obj: no such model file")));
  }
}

TEST_F(ShelfStage, LeavingEarlyDoesNotWaitForTheModels) {
  write_sheet("sheet.obj", 300);
  const auto start = std::chrono::steady_clock::now();
  { const ModelShelf shelf(carrying("sheet.obj"), folder_, *renderer); }
  const auto left = std::chrono::steady_clock::now() - start;
  ModelShelf shelf(carrying("sheet.obj"), folder_, *renderer);
  const auto begun = std::chrono::steady_clock::now();
  shelf.wait();
  EXPECT_LT(left, (std::chrono::steady_clock::now() - begun) / 2);
}

TEST_F(ShelfStage, MarkersShareAModelThatTheySayTheSameOf) {
  write_sheet("sheet.obj", 20);
  Catalog catalog = carrying("sheet.obj", {.fit = 60});
  catalog.markers[1].model = "sheet.obj";
  catalog.markers[1].import = {.fit = 60};
  ModelShelf same(catalog, folder_, *renderer);
  same.wait();
  EXPECT_EQ(*same.find(1)->model, *same.find(2)->model);
  catalog.markers[1].import = {.unit = LengthUnit::centimetre};
  ModelShelf other(catalog, folder_, *renderer);
  other.wait();
  EXPECT_NE(*other.find(1)->model, *other.find(2)->model);
  EXPECT_GT(other.find(2)->placement.reach, 100);
}

}  // namespace
}  // namespace onestroke
