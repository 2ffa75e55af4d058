// Neither following nor the quick look for newcomers allocates once warm.

#include "allocation/allocation_counter.h"
#include "scene_fixture.h"
#include "tracking/stereo_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <numbers>
#include <vector>

namespace onestroke::test {
namespace {

constexpr std::size_t round_of = 12;

/// Two markers that swing before the camera; the last picture leads back to the first.
std::vector<Shot> swing(const Catalog& catalog) {
  std::vector<Shot> shots;
  for (std::size_t i = 0; i < round_of; ++i) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(i) / round_of;
    const Quat turn = exp_so3({0.1 * std::sin(phase), 0, 0.1 * std::cos(phase)});
    const Pose left = about_middle(turn * exp_so3({0.3, -0.2, 0.4}), {-45 + 4 * std::cos(phase), 0, 420});
    const Pose right = about_middle(turn * exp_so3({-0.3, 0.2, 2.2}), {45, 4 * std::sin(phase), 420});
    shots.push_back(shoot({{&catalog.markers[1], left}, {&catalog.markers[4], right}}));
  }
  return shots;
}

/// Takes pictures whose times rise or fall and returns how often the thread allocated after the first two rounds.
long allocations(const std::vector<Shot>& shots, std::int64_t ms_apart) {
  Tracker tracker(catalog_of(6));
  FrameRecord record;
  long before = 0;
  std::size_t measured = 0, counted = 0;
  for (std::size_t i = 0; i < 6 * round_of; ++i) {
    if (i == 2 * round_of) before = allocations_of_this_thread();
    tracker.process(shots[i % round_of].picture(static_cast<std::int64_t>(i) * ms_apart), record);
    if (i < 2 * round_of) continue;
    ++counted;
    for (const MarkerObservation& o : record.seen()) measured += o.state == MarkerState::measured;
  }
  const long after = allocations_of_this_thread();
  EXPECT_EQ(measured, 2 * counted);
  return after - before;
}

TEST(TrackerAllocation, FollowingAllocatesNothingOnceWarm) {
  EXPECT_EQ(allocations(swing(catalog_of(6)), 33), 0);
}

// Each picture is older than the one before, so that the tracker starts afresh.
TEST(TrackerAllocation, LookingForNewcomersAllocatesNothingOnceWarm) {
  EXPECT_EQ(allocations(swing(catalog_of(6)), -1000), 0);
}

// On both trackers' threads.
TEST(StereoTrackerAllocation, FollowingAllocatesNothingOnceWarm) {
  const std::vector<Shot> shots = swing(catalog_of(6));
  StereoTracker tracker(catalog_of(6));
  const auto record = std::make_unique<FrameRecord>();
  long before = 0;
  for (std::size_t i = 0; i < 6 * round_of; ++i) {
    if (i == 2 * round_of) before = allocations_of_all_threads();
    const auto ms = static_cast<std::int64_t>(i) * 33;
    // The second camera sits where the first one does.
    const Picture second = shots[i % round_of].picture(ms);
    Picture first = second;
    first.second = &second;
    tracker.process(first, *record);
    if (i >= 2 * round_of) {
      EXPECT_EQ(record->marker_count, 2);
    }
  }
  EXPECT_EQ(allocations_of_all_threads(), before);
}

TEST(AllocationCounter, Counts) {
  const long own = allocations_of_this_thread(), all = allocations_of_all_threads();
  ::operator delete(::operator new(8));
  EXPECT_EQ(allocations_of_this_thread(), own + 1);
  EXPECT_GE(allocations_of_all_threads(), all + 1);
}

}  // namespace
}  // namespace onestroke::test
