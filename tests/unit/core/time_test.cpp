#include "core/time.h"

#include "core/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

namespace onestroke {
namespace {

TEST(Duration, ComesFromSecondsAndMillisecondsRoundedToNanoseconds) {
  EXPECT_EQ(Duration::from_seconds(1.5).ns, 1'500'000'000);
  EXPECT_EQ(Duration::from_ms(0.1).ns, 100'000);
  EXPECT_EQ(Duration::from_seconds(-0.3).ns, -300'000'000);
  EXPECT_EQ(Duration::from_seconds(2.6e-9).ns, 3);
  EXPECT_EQ(Duration::from_seconds(-2.6e-9).ns, -3);
  EXPECT_DOUBLE_EQ(Duration{1'250'000}.ms(), 1.25);
  EXPECT_DOUBLE_EQ(Duration{1'250'000'000}.seconds(), 1.25);
}

TEST(Duration, RoundTripsThroughSeconds) {
  for (std::int64_t ns : {0L, 1L, -1L, 999'999'999L, 123'456'789'012L, -86'400'000'000'000L})
    EXPECT_EQ(Duration::from_seconds(Duration{ns}.seconds()).ns, ns);
}

TEST(Time, DifferencesAndSumsAgree) {
  constexpr Time t{1'000}, later = t + Duration{500};
  static_assert(later - t == Duration{500} && later - Duration{500} == t && t < later);
  static_assert(-(t - later) == Duration{500} && 3 * Duration{2} == Duration{6} && Duration{7} / 2 == Duration{3});
}

TEST(Time, NowIsTheMonotonicClock) {
  timespec before{}, after{};
  clock_gettime(CLOCK_MONOTONIC, &before);
  const Time now = Time::now();
  clock_gettime(CLOCK_MONOTONIC, &after);
  EXPECT_GE(now.ns, before.tv_sec * 1'000'000'000 + before.tv_nsec);
  EXPECT_LE(now.ns, after.tv_sec * 1'000'000'000 + after.tv_nsec);
}

TEST(Exposure, MiddleIsThatOfTheMiddleRow) {
  // First row: 100 to 102 ms; last row, read 50 ms later: 150 to 152 ms.
  const Exposure exposure{{100'000'000}, Duration::from_ms(2), Duration::from_ms(50)};
  EXPECT_EQ(exposure.middle().ns, 126'000'000);
}

TEST(Intrinsics, FollowThePapersEquations) {
  const Intrinsics k = Intrinsics::from_fov(1600, 1200, 35 * std::numbers::pi / 180);
  EXPECT_NEAR(k.fx, 2537.3, 0.05);
  EXPECT_EQ(k.fy, k.fx);
  EXPECT_EQ(k.cx, 800);
  EXPECT_EQ(k.cy, 600);
  EXPECT_FALSE(k.distorted());
}

}  // namespace
}  // namespace onestroke
