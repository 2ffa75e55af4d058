#include "tracking/edge_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace onestroke::test {
namespace {

// The offset that is found for a Gaussian step from 0 to 1 with an offset and a blur, in units of the reach.
double found(double offset, double blur) {
  const EdgeStep step;
  double sum = -static_cast<double>(step.level), gained = 0;
  for (int i = 0; i < EdgeStep::samples; ++i) {
    const double x = EdgeStep::spacing * (i - EdgeStep::samples / 2) - offset;
    const double height = 0.5 * std::erfc(-x / blur / std::numbers::sqrt2);
    const auto k = static_cast<std::size_t>(i);
    sum += static_cast<double>(step.weight[k]) * height;
    gained += static_cast<double>(step.gain[k]) * height;
  }
  return static_cast<double>(EdgeStep::offset(static_cast<float>(sum), static_cast<float>(gained)));
}

TEST(EdgeStep, FindsNoOffsetWhereThereIsNone) {
  for (const double blur : {0.1, 0.2, 0.4, 0.7}) EXPECT_NEAR(found(0, blur), 0, 1e-6) << blur;
}

TEST(EdgeStep, FindsAStepLikeItsOwn) {
  for (const double offset : {-0.3, -0.1, 0.05, 0.2})
    EXPECT_NEAR(found(offset, EdgeStep::blur), offset, 0.002) << offset;
}

TEST(EdgeStep, PutsRightWhatIsSteeperOrFlatter) {
  for (const double blur : {0.15, 0.25, 0.55})
    for (const double offset : {-0.2, -0.05, 0.1, 0.25})
      EXPECT_NEAR(found(offset, blur), offset, 0.002) << offset << ", as wide as " << blur;
}

// Past the step the colour changes by 0.2 of it in each reach, and is its own one reach on.
TEST(EdgeStep, TellsWhatAColourThatGoesOnChangingMovesItBy) {
  constexpr double slope = 0.2;
  const EdgeStep step;
  double sum = -static_cast<double>(step.level);
  for (int i = 0; i < EdgeStep::samples; ++i) {
    const double x = EdgeStep::spacing * (i - EdgeStep::samples / 2);
    const double height = 0.5 * std::erfc(-x / EdgeStep::blur / std::numbers::sqrt2);
    sum += static_cast<double>(step.weight[static_cast<std::size_t>(i)]) * height * (1 + slope * (x - 1));
  }
  EXPECT_NEAR(sum, slope * static_cast<double>(step.ramp), 1e-6);
  EXPECT_GT(step.ramp, 0.3F) << "of a reach";
}

TEST(EdgeStep, KeepsTheOrderOfOffsets) {
  for (const double blur : {0.2, 0.4, 0.6})
    for (double offset = -0.5; offset < 0.45; offset += 0.1) EXPECT_LT(found(offset, blur), found(offset + 0.1, blur));
}

}  // namespace
}  // namespace onestroke::test
