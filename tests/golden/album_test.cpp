// The golden pictures' own rules, with an album made for the test.
#include "golden/album.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace onestroke::golden {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const std::string mesa = "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6 (LLVM 15.0.6)";
const std::string newer_mesa = "llvmpipe (LLVM 15.0.7, 256 bits), Mesa 23.0.0 (LLVM 15.0.7)";

class AlbumTest : public testing::Test {
 protected:
  AlbumTest() {
    record(mesa);
    write_png(pictures / "one.png", picture(100));
  }
  ~AlbumTest() override { fs::remove_all(folder); }

  static Picture picture(std::uint8_t level) { return {4, 3, std::vector<std::uint8_t>(36, level)}; }
  void record(const std::string& driver) const {
    fs::create_directories(pictures);
    std::ofstream(pictures / "made_with.txt") << driver << '\n';
  }
  Album album(const std::string& drawn_by, const std::string& bless = "") {
    return Album({pictures, failures}, drawn_by, bless, out);
  }
  int kept(const std::string& name) const { return read_png(pictures / (name + ".png")).rgb[0]; }

  const fs::path folder = fs::path(testing::TempDir()) / ("album_" + std::to_string(::getpid()));
  const fs::path pictures = folder / "pictures", failures = folder / "failures";
  const Tolerance tolerance{.level = 2};
  std::ostringstream out;
};

TEST_F(AlbumTest, HasNothingToSayOfWhatLooksAsExpected) {
  EXPECT_EQ(album(mesa).check("one", picture(102), tolerance), "");
  EXPECT_FALSE(fs::exists(failures));
}

TEST_F(AlbumTest, ShowsWhatLooksDifferentAndHowToBlessIt) {
  const std::string wrong = album(mesa).check("one", picture(103), tolerance);
  EXPECT_THAT(wrong, AllOf(HasSubstr("12 pixels"), HasSubstr("tests/bless one")));
  for (const std::string what : {"expected", "actual", "difference"})
    EXPECT_TRUE(fs::exists(failures / ("one." + what + ".png"))) << what;
  EXPECT_EQ(kept("one"), 100);
}

TEST_F(AlbumTest, SaysWhereAPictureIsMissing) {
  EXPECT_THAT(album(mesa).check("two", picture(1), tolerance),
              AllOf(HasSubstr("two.png"), HasSubstr("tests/bless two")));
}

TEST_F(AlbumTest, RefusesToCompareWhatAnotherDriverDrew) {
  const std::string wrong = album(newer_mesa).check("one", picture(100), tolerance);
  EXPECT_THAT(wrong, AllOf(HasSubstr("one was drawn by " + mesa), HasSubstr(newer_mesa), HasSubstr("not compared"),
                           HasSubstr("tests/bless")));
  fs::remove(pictures / "made_with.txt");
  EXPECT_THAT(album(mesa).check("one", picture(100), tolerance), HasSubstr("not compared"));
}

TEST_F(AlbumTest, TakesTheProcessorsVectorsForNoOtherDriver) {
  EXPECT_TRUE(draw_alike(mesa, "llvmpipe (LLVM 15.0.6, 128 bits), Mesa 22.3.6 (LLVM 15.0.6)"));
  EXPECT_FALSE(draw_alike(mesa, newer_mesa));
  EXPECT_FALSE(draw_alike(mesa, "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6 (LLVM 14.0.0)"));
  EXPECT_FALSE(draw_alike(mesa, "AMD RADV NAVI10, Mesa 22.3.6 (LLVM 15.0.6)"));
  EXPECT_FALSE(draw_alike(mesa, ""));
  EXPECT_TRUE(draw_alike("A card, 535.1", "A card, 535.1"));
}

TEST_F(AlbumTest, BlessesWhatItIsAskedTo) {
  EXPECT_EQ(album(mesa, "two,one").check("one", picture(103), tolerance), "");
  EXPECT_EQ(kept("one"), 103);
  EXPECT_EQ(album(mesa, "two,one").check("two", picture(7), tolerance), "");
  EXPECT_EQ(kept("two"), 7);
  EXPECT_THAT(out.str(),
              AllOf(HasSubstr("blessed one: changed, 12 pixels"), HasSubstr("blessed two: new\ndrawn by " + mesa)));
  EXPECT_NE(album(mesa, "two").check("one", picture(50), tolerance), "") << "others are still compared";
  EXPECT_EQ(kept("one"), 103);
}

TEST_F(AlbumTest, LeavesAFileAloneThatShowsTheSame) {
  const auto written = fs::last_write_time(pictures / "one.png");
  EXPECT_EQ(album(mesa, "all").check("one", picture(100), tolerance), "");
  EXPECT_EQ(fs::last_write_time(pictures / "one.png"), written);
  EXPECT_THAT(out.str(), HasSubstr("blessed one: same\n"));
}

TEST_F(AlbumTest, LeavesAFileAloneThatIsAsGoodUnlessAskedByNameOrDrawnByAnotherDriver) {
  EXPECT_EQ(album(mesa, "all").check("one", picture(102), tolerance), "");
  EXPECT_EQ(kept("one"), 100);
  EXPECT_THAT(out.str(), HasSubstr("blessed one: the same but for what its test forgives\n"));
  EXPECT_EQ(album(mesa, "all").check("one", picture(103), tolerance), "");
  EXPECT_EQ(kept("one"), 103);
  EXPECT_EQ(album(mesa, "one").check("one", picture(104), tolerance), "");
  EXPECT_EQ(kept("one"), 104);
  EXPECT_EQ(album(newer_mesa, "all").check("one", picture(105), tolerance), "");
  EXPECT_EQ(kept("one"), 105);
}

TEST_F(AlbumTest, BlessesAllOrNoneWithAnotherDriver) {
  EXPECT_THAT(album(newer_mesa, "one").check("one", picture(103), tolerance), HasSubstr("not compared"));
  EXPECT_EQ(kept("one"), 100);
  EXPECT_EQ(album(newer_mesa, "all").check("one", picture(103), tolerance), "");
  EXPECT_EQ(kept("one"), 103);
}

}  // namespace
}  // namespace onestroke::golden
