#include "core/latest_exchange.h"

#include "core/picture_pool.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace onestroke {
namespace {

TEST(LatestExchange, GivesTheNewestOnce) {
  LatestExchange<std::shared_ptr<int>> exchange;
  EXPECT_FALSE(exchange.take());
  for (int i = 1; i <= 3; ++i) exchange.publish(std::make_shared<int>(i));
  EXPECT_EQ(exchange.dropped(), 2u);
  const auto taken = exchange.take();
  ASSERT_TRUE(taken);
  EXPECT_EQ(*taken, 3);
  EXPECT_FALSE(exchange.take());
  exchange.publish(std::make_shared<int>(4));
  EXPECT_EQ(*exchange.take(), 4);
  EXPECT_EQ(exchange.dropped(), 2u);
}

TEST(LatestExchange, ReleasesWhatIsReplacedAtOnceAndTheRestAtItsEnd) {
  PicturePool pool(4, 16);
  {
    LatestExchange<PictureHandle> exchange;
    for (int i = 0; i < 10; ++i) {
      auto* loan = pool.acquire();
      ASSERT_NE(loan, nullptr);
      exchange.publish(PictureHandle(*loan));
      EXPECT_EQ(pool.lent(), 1u);
    }
    {
      const PictureHandle taken = exchange.take();
      EXPECT_TRUE(taken);
      EXPECT_EQ(pool.lent(), 1u);
    }
    EXPECT_EQ(pool.lent(), 0u);
    exchange.publish(PictureHandle(*pool.acquire()));
  }
  EXPECT_EQ(pool.lent(), 0u);
}

// A camera thread against a slower and a faster consumer: order is kept, contents are whole, no buffer is lost.
TEST(LatestExchange, ThreadsExchangePictures) {
  constexpr std::uint64_t last = 100'000;
  constexpr std::size_t bytes = 512;
  PicturePool pool(4, bytes);
  LatestExchange<PictureHandle> exchange;
  std::uint64_t starved = 0;
  std::jthread camera([&] {
    for (std::uint64_t i = 1; i <= last; ++i) {
      auto* loan = pool.acquire();
      // At most one is held by the consumer, one waits and one is being filled, so a fourth is always free.
      if (loan == nullptr) {
        ++starved;
        continue;
      }
      for (std::uint8_t& byte : pool.bytes(*loan)) byte = static_cast<std::uint8_t>(i);
      loan->picture.sequence = i;
      loan->picture.planes[0] = pool.bytes(*loan).data();
      exchange.publish(PictureHandle(*loan));
    }
  });
  std::uint64_t newest = 0, taken = 0;
  while (newest < last) {
    const PictureHandle picture = exchange.take();
    if (!picture) {
      std::this_thread::yield();
      continue;
    }
    ++taken;
    ASSERT_GT(picture->sequence, newest);
    newest = picture->sequence;
    for (std::size_t i = 0; i < bytes; ++i)
      ASSERT_EQ(picture->planes[0][i], static_cast<std::uint8_t>(newest)) << "torn at byte " << i;
  }
  camera.join();
  EXPECT_EQ(starved, 0u);
  EXPECT_EQ(taken + exchange.dropped(), last);
  EXPECT_EQ(pool.lent(), 0u);
}

}  // namespace
}  // namespace onestroke
