#include "marker/color_code.h"

#include "../core/error_of.h"
#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace onestroke {
namespace {

using testing::HasSubstr;

Cells reversed(Cells cells) {
  std::reverse(cells.begin(), cells.end());
  return cells;
}

TEST(ColorCode, ForwardIsZeroAndMostSignificantComesFirst) {
  EXPECT_EQ(to_letters(encode(0, 3)), "RGB");
  EXPECT_EQ(to_letters(encode(1, 3)), "RBG");
  EXPECT_EQ(to_letters(encode(0b10, 4)), "RBRG");
  EXPECT_EQ(to_letters(encode(0b01, 4)), "RGRG");
  EXPECT_EQ(to_letters(encode(0b00, 4)), "RGBG");
}

TEST(ColorCode, StopRuleKeepsTheLastCellFromRed) {
  EXPECT_EQ(encode(0, 3).back(), CellColor::blue);      // after green
  EXPECT_EQ(encode(1, 3).back(), CellColor::green);     // after blue
  EXPECT_EQ(encode(0b01, 4).back(), CellColor::green);  // after red
}

TEST(ColorCode, EveryValueOfSmallCodesComesBack) {
  for (int n = 3; n <= 16; ++n) {
    std::set<std::string> seen;
    for (std::uint64_t value = 0; value >> (n - 2) == 0; ++value) {
      const Cells cells = encode(value, n);
      ASSERT_EQ(cells.size(), static_cast<std::size_t>(n));
      ASSERT_EQ(law_violation(cells), "");
      ASSERT_EQ(decode(cells), value);
      ASSERT_EQ(decode_either_end(cells), value);
      ASSERT_EQ(decode_either_end(reversed(cells)), value);
      seen.insert(to_letters(cells));
    }
    EXPECT_EQ(seen.size(), std::size_t{1} << (n - 2));
  }
}

TEST(ColorCode, RandomValuesOfLongCodesComeBack) {
  std::mt19937_64 random(1);
  for (int n : {17, 36, 63, 64}) {
    const std::uint64_t mask = (std::uint64_t{1} << (n - 2)) - 1;
    for (int i = 0; i < 2000; ++i) {
      const std::uint64_t value = i == 0 ? mask : random() & mask;
      const Cells cells = encode(value, n);
      ASSERT_EQ(law_violation(cells), "");
      ASSERT_EQ(decode(cells), value);
      ASSERT_EQ(decode_either_end(reversed(cells)), value);
      ASSERT_EQ(cells_from_letters(to_letters(cells)), cells);
    }
  }
}

TEST(ColorCode, ThirtySixCellsCarryThirtyFourBits) {
  EXPECT_NO_THROW(encode((std::uint64_t{1} << 34) - 1, 36));
  EXPECT_THAT(error_of([] { encode(std::uint64_t{1} << 34, 36); }), HasSubstr("the largest is 17179869183"));
}

TEST(ColorCode, StopCellCarriesNoData) {
  EXPECT_EQ(decode(cells_from_letters("RGRG")), decode(cells_from_letters("RGRB")));
}

// The law, stated once more as plainly as it can be, over every word of up to nine letters.
TEST(ColorCode, LawHoldsForExactlyTheLawfulWords) {
  for (int n = 1; n <= 9; ++n) {
    int words = 1;
    for (int i = 0; i < n; ++i) words *= 3;
    for (int word = 0; word < words; ++word) {
      Cells cells;
      for (int i = 0, rest = word; i < n; ++i, rest /= 3) cells.push_back(static_cast<CellColor>(rest % 3));
      bool lawful = n >= 3 && cells.front() == CellColor::red && cells.back() != CellColor::red;
      for (std::size_t i = 1; i < cells.size(); ++i) lawful = lawful && cells[i] != cells[i - 1];
      ASSERT_EQ(law_violation(cells).empty(), lawful) << to_letters(cells);
      ASSERT_TRUE(!lawful || !law_violation(reversed(cells)).empty()) << "reads from both ends: " << to_letters(cells);
    }
  }
}

TEST(ColorCode, SaysWhatIsWrong) {
  EXPECT_THAT(error_of([] { cells_from_letters("RGX"); }), HasSubstr("cell 3 is 'X'"));
  EXPECT_THAT(law_violation(cells_from_letters("RG")), HasSubstr("not 2"));
  EXPECT_THAT(law_violation(Cells(65, CellColor::red)), HasSubstr("not 65"));
  EXPECT_THAT(law_violation(cells_from_letters("GRB")), HasSubstr("first cell is green"));
  EXPECT_THAT(law_violation(cells_from_letters("RGGB")), HasSubstr("cells 2 and 3 are both green"));
  EXPECT_THAT(law_violation(cells_from_letters("RGBR")), HasSubstr("last cell is red"));
  EXPECT_THAT(error_of([] { decode_either_end(cells_from_letters("RGBR")); }), HasSubstr("both ends are red"));
  EXPECT_THAT(error_of([] { decode_either_end(cells_from_letters("GBG")); }), HasSubstr("neither end is red"));
  EXPECT_THAT(error_of([] { decode_either_end({}); }), HasSubstr("neither end is red"));
  EXPECT_THAT(error_of([] { encode(0, 2); }), HasSubstr("3 to 64 cells"));
  EXPECT_THAT(error_of([] { encode(0, 65); }), HasSubstr("3 to 64 cells"));
}

}  // namespace
}  // namespace onestroke
