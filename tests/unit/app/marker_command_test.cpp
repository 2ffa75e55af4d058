#include "app/marker_command.h"

#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace onestroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;
using Action = MarkerOptions::Action;

MarkerSpec marker(int id, const std::string& name, std::uint64_t value, Shape shape, std::string model = "") {
  return {id, name, encode(value, shape.cells()), std::move(shape), std::move(model)};
}

Catalog example() {
  return {{marker(1, "m01", 1, Shape::angle(8, 4, 1, 0), "bracket.glb"), marker(12, "Stück", 2, Shape::line(6, 4, 3))}};
}

class MarkerCommandTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "onestroke-marker-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::ofstream(json_ = folder_ / "in.json") << to_json(example());
    store_ = folder_ / "catalog.db";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string run(MarkerOptions options) {
    std::ostringstream out;
    EXPECT_EQ(marker_command(options, out), 0);
    return out.str();
  }
  std::string import(bool replace = false) {
    return run({.action = Action::import, .catalog = store_, .input = json_, .replace = replace});
  }
  std::string refusal(const MarkerOptions& options) {
    std::ostringstream out;
    try {
      marker_command(options, out);
    } catch (const Error& error) {
      return error.what();
    }
    return "done";
  }

  fs::path folder_, json_, store_;
};

TEST_F(MarkerCommandTest, ImportAndExportAreInverse) {
  EXPECT_EQ(import(), "2 markers imported; " + store_.string() + " holds 2\n");
  EXPECT_EQ(run({.action = Action::export_, .catalog = store_}), to_json(example()));
  const fs::path file = folder_ / "out.json";
  EXPECT_EQ(run({.action = Action::export_, .catalog = store_, .output = file}), "");
  std::ifstream in(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), to_json(example()));
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

TEST_F(MarkerCommandTest, ImportTwiceNeedsReplace) {
  import();
  EXPECT_THAT(refusal({.action = Action::import, .catalog = store_, .input = json_}), HasSubstr("--replace"));
  EXPECT_EQ(import(true), "2 markers imported; " + store_.string() + " holds 2\n");
}

TEST_F(MarkerCommandTest, ABadImportMakesNoStore) {
  std::ofstream(json_) << R"({"markers": [{"id": 1}]})";
  EXPECT_THAT(refusal({.action = Action::import, .catalog = store_, .input = json_}),
              HasSubstr("in.json: marker 1: key \"name\" is missing"));
  EXPECT_FALSE(fs::exists(store_));
  EXPECT_THAT(refusal({.action = Action::import, .catalog = store_, .input = folder_ / "none"}),
              HasSubstr("none cannot be read"));
  EXPECT_THAT(refusal({.action = Action::import, .catalog = store_, .input = folder_}), HasSubstr("is a folder"));
}

TEST_F(MarkerCommandTest, ExportThatCannotBeWrittenLeavesNothing) {
  import();
  EXPECT_THAT(refusal({.action = Action::export_, .catalog = store_, .output = folder_ / "none" / "out.json"}),
              HasSubstr("cannot be written"));
  fs::create_directories(folder_ / "taken" / "inside");
  EXPECT_THAT(refusal({.action = Action::export_, .catalog = store_, .output = folder_ / "taken"}),
              HasSubstr("cannot be written"));
  EXPECT_FALSE(fs::exists(folder_ / "taken.part"));
}

TEST_F(MarkerCommandTest, AFullStandardOutputIsAnError) {
  import();
  std::ofstream full("/dev/full");
  EXPECT_THROW(marker_command({.action = Action::list, .catalog = store_}, full), Error);
}

TEST_F(MarkerCommandTest, ListIsATable) {
  import();
  EXPECT_EQ(run({.action = Action::list, .catalog = store_}),
            "ID  NAME   SHAPE  CELLS  PITCH  RADIUS  BEND  MODEL\n"
            "1   m01    angle  8      4      1       0     bracket.glb\n"
            "12  Stück  line   6      4      3       0     -\n");
  EXPECT_EQ(run({.action = Action::list, .catalog = json_}), run({.action = Action::list, .catalog = store_}));
}

TEST_F(MarkerCommandTest, ShowFindsByIdAndByName) {
  import();
  const std::string by_id = run({.action = Action::show, .catalog = store_, .which = "12"});
  EXPECT_EQ(by_id, run({.action = Action::show, .catalog = store_, .which = "Stück"}));
  for (const char* none : {"13", "m02", "12x", ""})
    EXPECT_THAT(refusal({.action = Action::show, .catalog = store_, .which = none}),
                AllOf(HasSubstr("there is no marker"), HasSubstr("marker list")));
}

TEST(MarkerDescription, SaysEverything) {
  const std::string text = describe(marker(4, "m04", 5, Shape::angle(36, 4, 3, 8), "b.glb"));
  for (const char* part : {"4", "m04", "b.glb", "5 of 17179869184 (34 bits)", "angle, 36 cells of 4 mm, 144 mm in all",
                           "radius 3 mm", "8 mm", "straight 65.717, arc 12.566 (radius 8, 90 degrees), straight 65.717",
                           "(0, -73.717, 0)", "(73.717, 0, 0)", "six degrees"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(MarkerDescription, SaysWhatIsSaidOfTheModel) {
  MarkerSpec part = marker(4, "m04", 5, Shape::angle(36, 4, 3, 8), "part.stl");
  part.import = {.unit = LengthUnit::inch, .up = UpAxis::z, .fit = 60};
  EXPECT_THAT(describe(part), HasSubstr("part.stl, in, z up, fit 60 mm\n"));
  EXPECT_THAT(describe(Catalog{{part}}), HasSubstr("part.stl, in, z up, fit 60 mm\n"));
}

TEST(MarkerDescription, SaysWhatTheModelIs) {
  MarkerSpec part = marker(4, "m04", 5, Shape::angle(8, 4, 1, 0), "part.stl");
  part.model_name = "Bracket";
  part.version = "v2";
  part.notes = {{"material", "6061-T6"}, {"changed", "two ribs"}};
  EXPECT_THAT(describe(part), HasSubstr("model        part.stl\n"
                                        "  name       Bracket\n"
                                        "  version    v2\n"
                                        "  material   6061-T6\n"
                                        "  changed    two ribs\n"
                                        "cells "));
  EXPECT_EQ(describe(Catalog{{part, marker(12, "m12", 2, Shape::line(6, 4, 3))}}),
            "ID  NAME  SHAPE  CELLS  PITCH  RADIUS  BEND  MODEL     VERSION\n"
            "4   m04   angle  8      4      1       0     part.stl  v2\n"
            "12  m12   line   6      4      3       0     -         -\n");
}

TEST(MarkerDescription, ASharpAngleLooksLikeTheLetterL) {
  const MarkerSpec sharp = marker(1, "a", 0, Shape::angle(8, 4, 1, 0));
  EXPECT_EQ(letter_picture(sharp),
            "seen along z: x to the right, y down\n\n"
            "    R\n"
            "    G\n"
            "    B\n"
            "    R\n"
            "     G B R G\n");
}

TEST(MarkerDescription, AStrokeInAnotherPlaneIsSeenFromItsFlatSide) {
  const MarkerSpec stroke = marker(1, "a", 0, Shape::stroke(6, 4, 1, 0, {{0, 0, 0}, {0, 12, 0}, {0, 12, 12}}));
  EXPECT_EQ(letter_picture(stroke),
            "seen along x: y to the right, z down\n\n"
            "    R G B\n"
            "         R\n"
            "         G\n"
            "         B\n");
  const MarkerSpec line = marker(1, "a", 0, Shape::line(4, 4, 1));
  EXPECT_EQ(letter_picture(line), "seen along z: x to the right, y down\n\n    R G B G\n");
}

}  // namespace
}  // namespace onestroke
