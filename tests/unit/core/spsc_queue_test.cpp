#include "core/spsc_queue.h"

#include "core/frame_record.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace onestroke {
namespace {

TEST(SpscQueue, TakesPowersOfTwoOnly) {
  EXPECT_THROW(SpscQueue<int>(0), Error);
  EXPECT_THROW(SpscQueue<int>(12), Error);
  EXPECT_EQ(SpscQueue<int>(1).capacity(), 1u);
  EXPECT_EQ(SpscQueue<int>(16).capacity(), 16u);
}

TEST(SpscQueue, DrainsAllInOrder) {
  SpscQueue<int> queue(8);
  std::vector<int> taken;
  const auto take = [&](int value) { taken.push_back(value); };
  EXPECT_EQ(queue.drain(take), 0u);
  for (int round = 0; round < 5; ++round) {
    taken.clear();
    for (int i = 0; i < 7; ++i) EXPECT_TRUE(queue.push(i));
    EXPECT_EQ(queue.drain(take), 7u);
    EXPECT_EQ(taken, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  }
}

TEST(SpscQueue, CountsWhatDoesNotFitAndGoesOn) {
  SpscQueue<int> queue(4);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push(i));
  EXPECT_FALSE(queue.push(4));
  EXPECT_FALSE(queue.push_with([](int&) { FAIL() << "written into a full queue"; }));
  EXPECT_EQ(queue.overflow(), 2u);
  int expected = 0;
  queue.drain([&](int value) { EXPECT_EQ(value, expected++); });
  EXPECT_EQ(expected, 4);
  EXPECT_TRUE(queue.push(9));
}

TEST(SpscQueue, LeavesARefusedValueAsItWas) {
  SpscQueue<std::unique_ptr<int>> queue(1);
  EXPECT_TRUE(queue.push(std::make_unique<int>(1)));
  auto second = std::make_unique<int>(2);
  EXPECT_FALSE(queue.push(std::move(second)));
  ASSERT_TRUE(second);
  EXPECT_EQ(*second, 2);
}

TEST(SpscQueue, DestroysWhatIsDrainedAndNotTaken) {
  SpscQueue<std::shared_ptr<int>> queue(4);
  const auto value = std::make_shared<int>(3);
  queue.push(value);
  queue.push(value);
  std::shared_ptr<int> kept;
  queue.drain([&](std::shared_ptr<int>& p) {
    if (!kept) kept = std::move(p);
  });
  EXPECT_EQ(value.use_count(), 2);
}

TEST(SpscQueue, CarriesFrameRecordsWrittenInPlace) {
  static_assert(std::is_trivially_copyable_v<FrameRecord>);
  SpscQueue<FrameRecord> queue(2);
  EXPECT_TRUE(queue.push_with([](FrameRecord& record) {
    record.sequence = 7;
    record.marker_count = 1;
    record.markers[0].id = 3;
  }));
  queue.drain([](const FrameRecord& record) {
    EXPECT_EQ(record.sequence, 7u);
    ASSERT_EQ(record.seen().size(), 1u);
    EXPECT_EQ(record.seen()[0].id, 3);
  });
}

/// Big enough that a torn read would show: every word says the same.
struct Wide {
  std::array<std::uint64_t, 40> words{};
};

TEST(SpscQueue, ThreadsExchangeEverythingInOrder) {
  constexpr std::uint64_t last = 200'000;
  SpscQueue<Wide> queue(64);
  std::uint64_t refused = 0;
  std::jthread producer([&](const std::stop_token& stop) {
    for (std::uint64_t i = 1; i <= last && !stop.stop_requested();) {
      if (queue.push_with([&](Wide& wide) { wide.words.fill(i); })) {
        ++i;
      } else {
        ++refused;
        std::this_thread::yield();
      }
    }
  });
  std::uint64_t expected = 1;
  while (expected <= last) {
    const std::size_t taken = queue.drain([&](const Wide& wide) {
      for (const std::uint64_t word : wide.words) ASSERT_EQ(word, expected);
      ++expected;
    });
    if (taken == 0) std::this_thread::yield();
    ASSERT_FALSE(HasFatalFailure());
  }
  producer.join();
  EXPECT_EQ(queue.overflow(), refused);
  EXPECT_EQ(queue.drain([](const Wide&) {}), 0u);
}

TEST(SpscQueue, AProducerThatNeverWaitsLosesOnlyWhatItCounts) {
  constexpr std::uint64_t last = 300'000;
  SpscQueue<std::uint64_t> queue(16);
  std::atomic<bool> done{false};
  std::jthread producer([&] {
    for (std::uint64_t i = 1; i <= last; ++i) queue.push(i);
    done = true;
  });
  std::uint64_t taken = 0, newest = 0;
  const auto take = [&](std::uint64_t value) {
    ASSERT_GT(value, newest);
    newest = value;
    ++taken;
  };
  while (!done && !HasFatalFailure()) queue.drain(take);
  producer.join();
  queue.drain(take);
  EXPECT_EQ(taken + queue.overflow(), last);
}

}  // namespace
}  // namespace onestroke
