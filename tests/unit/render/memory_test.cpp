#include "render/memory.h"

#include <gtest/gtest.h>

#include <random>

namespace onestroke {
namespace {

TEST(BlockSpace, TakesFromTheFrontAndAligns) {
  BlockSpace space(1000);
  EXPECT_EQ(space.take(10, 1), 0U);
  EXPECT_EQ(space.take(100, 64), 64U);
  EXPECT_EQ(space.take(20, 1), 10U);  // the gap that alignment left
  EXPECT_EQ(space.free_bytes(), 870U);
}

TEST(BlockSpace, HasNothingWhereNothingFits) {
  BlockSpace space(100);
  EXPECT_EQ(space.take(60, 1), 0U);
  EXPECT_EQ(space.take(60, 1), std::nullopt);
  EXPECT_EQ(space.take(40, 64), std::nullopt);
  EXPECT_EQ(space.take(40, 4), 60U);
  EXPECT_EQ(space.take(1, 1), std::nullopt);
}

TEST(BlockSpace, JoinsWhatComesBack) {
  BlockSpace space(300);
  ASSERT_EQ(space.take(100, 1), 0U);
  ASSERT_EQ(space.take(100, 1), 100U);
  ASSERT_EQ(space.take(100, 1), 200U);
  space.give_back(0, 100);
  space.give_back(200, 100);
  EXPECT_EQ(space.take(150, 1), std::nullopt);
  space.give_back(100, 100);
  EXPECT_EQ(space.take(300, 1), 0U);
}

TEST(BlockSpace, NeverLendsAByteTwiceAndLosesNone) {
  constexpr std::uint64_t size = 1U << 16U;
  BlockSpace space(size);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> held;
  std::vector<bool> lent(size);
  std::mt19937 random(7);
  for (int step = 0; step < 4000; ++step) {
    if (held.empty() || random() % 5 < 3) {
      const std::uint64_t bytes = 1 + random() % 900, alignment = std::uint64_t{1} << random() % 9;
      const auto at = space.take(bytes, alignment);
      if (!at) continue;
      ASSERT_EQ(*at % alignment, 0U);
      for (std::uint64_t i = *at; i < *at + bytes; ++i) {
        ASSERT_FALSE(lent[i]);
        lent[i] = true;
      }
      held.emplace_back(*at, bytes);
    } else {
      const std::size_t which = random() % held.size();
      const auto [at, bytes] = held[which];
      std::fill_n(lent.begin() + static_cast<std::ptrdiff_t>(at), bytes, false);
      space.give_back(at, bytes);
      held[which] = held.back();
      held.pop_back();
    }
  }
  for (const auto& [at, bytes] : held) space.give_back(at, bytes);
  EXPECT_EQ(space.take(size, 1), 0U);
}

}  // namespace
}  // namespace onestroke
