#include "golden/comparator.h"

#include "core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace onestroke::golden {
namespace {

Picture grey(int width, int height, std::uint8_t level) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), level)};
}

TEST(Comparator, FindsEqualPicturesTheSame) {
  const auto result = compare(grey(4, 3, 90), grey(4, 3, 90), {.level = 0});
  EXPECT_TRUE(result.same);
  EXPECT_EQ(result.worst, 0);
  EXPECT_EQ(result.differing, 0);
}

TEST(Comparator, ForgivesUpToTheLevelAndNoFurther) {
  Picture other = grey(4, 3, 90);
  other.at(2, 1)[1] = 93;
  EXPECT_TRUE(compare(grey(4, 3, 90), other, {.level = 3}).same);
  const auto result = compare(grey(4, 3, 90), other, {.level = 2});
  EXPECT_FALSE(result.same);
  EXPECT_EQ(result.worst, 3);
  EXPECT_EQ(result.differing, 1);
}

TEST(Comparator, CountsDarkerAsWellAsBrighter) {
  Picture other = grey(4, 3, 90);
  other.at(0, 0)[2] = 0;
  EXPECT_EQ(compare(grey(4, 3, 90), other, {.level = 10}).worst, 90);
}

TEST(Comparator, ForgivesAsManyPixelsAsToldAndNoMore) {
  Picture other = grey(8, 8, 90);
  for (int x = 0; x < 5; ++x) other.at(x, 3)[0] = 250;
  EXPECT_TRUE(compare(grey(8, 8, 90), other, {.level = 1, .pixels = 5}).same);
  EXPECT_FALSE(compare(grey(8, 8, 90), other, {.level = 1, .pixels = 4}).same);
}

TEST(Comparator, MarksTheDifferenceInRed) {
  Picture other = grey(4, 3, 90);
  other.at(3, 2)[0] = 200;
  const auto result = compare(grey(4, 3, 90), other, {.level = 1});
  const auto* marked = result.difference.at(3, 2);
  const auto* plain = result.difference.at(0, 0);
  EXPECT_GT(marked[0], 200);
  EXPECT_EQ(marked[1], 0);
  EXPECT_EQ(plain[0], plain[1]);
}

TEST(Comparator, NeverForgivesAnotherSize) {
  const auto result = compare(grey(4, 3, 90), grey(3, 4, 90), {.level = 255, .pixels = 1000});
  EXPECT_FALSE(result.same);
  EXPECT_THAT(result.words, testing::HasSubstr("3 x 4 instead of 4 x 3"));
}

TEST(Comparator, KeepsPicturesThroughPng) {
  Picture p = grey(5, 4, 0);
  for (std::size_t i = 0; i < p.rgb.size(); ++i) p.rgb[i] = static_cast<std::uint8_t>(i * 37 % 256);
  const auto file = std::filesystem::path(testing::TempDir()) / "comparator_round_trip.png";
  write_png(file, p);
  const Picture back = read_png(file);
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 4);
  EXPECT_EQ(back.rgb, p.rgb);
  EXPECT_THROW(read_png(file.string() + ".missing"), Error);
}

}  // namespace
}  // namespace onestroke::golden
