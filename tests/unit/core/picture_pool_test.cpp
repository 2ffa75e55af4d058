#include "core/picture_pool.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <thread>
#include <vector>

namespace onestroke {
namespace {

TEST(PicturePool, LendsEachBufferOnceAndTakesItBack) {
  PicturePool pool(3, 100);
  std::set<PictureHandle::Loan*> loans;
  for (int i = 0; i < 3; ++i) loans.insert(pool.acquire());
  EXPECT_EQ(loans.size(), 3u);
  EXPECT_FALSE(loans.contains(nullptr));
  EXPECT_EQ(pool.acquire(), nullptr);
  EXPECT_EQ(pool.lent(), 3u);
  pool.give_back(**loans.begin());
  EXPECT_EQ(pool.acquire(), *loans.begin());
}

TEST(PicturePool, BuffersAreAlignedAndApart) {
  PicturePool pool(4, 100);
  std::vector<std::uint8_t*> starts;
  for (std::size_t i = 0; i < 4; ++i) {
    auto* loan = pool.acquire();
    EXPECT_EQ(pool.index(*loan), i);
    EXPECT_EQ(pool.index(loan->picture), i);
    EXPECT_EQ(pool.bytes(*loan).size(), 100u);
    starts.push_back(pool.bytes(*loan).data());
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(starts.back()) % 64, 0u);
    std::ranges::fill(pool.bytes(*loan), std::uint8_t{1});
  }
  std::ranges::sort(starts);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GE(starts[i] - starts[i - 1], 100);
  EXPECT_EQ(pool.index(Picture{}), 4u);
}

TEST(PicturePool, RefusesToBeEmpty) {
  EXPECT_THROW(PicturePool(0, 100), Error);
  EXPECT_THROW(PicturePool(3, 0), Error);
}

TEST(PicturePool, TheLastHandleGivesBack) {
  PicturePool pool(1, 8);
  PictureHandle first(*pool.acquire());
  PictureHandle second = first;
  PictureHandle third = std::move(first);
  EXPECT_FALSE(first);
  second.reset();
  second.reset();
  EXPECT_EQ(pool.lent(), 1u);
  third = PictureHandle{};
  EXPECT_EQ(pool.lent(), 0u);
}

TEST(PicturePool, AReusedBufferStartsBlank) {
  PicturePool pool(1, 8);
  {
    auto* loan = pool.acquire();
    loan->picture.width = 640;
    const PictureHandle handle(*loan);
  }
  EXPECT_EQ(pool.acquire()->picture.width, 0);
}

TEST(PicturePool, ThreadsNeverShareABuffer) {
  PicturePool pool(3, 64);
  std::vector<std::jthread> threads;
  std::atomic<int> torn{0};
  for (int id = 1; id <= 4; ++id)
    threads.emplace_back([&, id] {
      for (int i = 0; i < 20'000; ++i) {
        auto* loan = pool.acquire();
        if (loan == nullptr) continue;
        const PictureHandle handle(*loan);
        const auto bytes = pool.bytes(*loan);
        std::ranges::fill(bytes, static_cast<std::uint8_t>(id));
        if (!std::ranges::all_of(bytes, [&](std::uint8_t b) { return b == id; })) ++torn;
      }
    });
  threads.clear();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(pool.lent(), 0u);
}

}  // namespace
}  // namespace onestroke
