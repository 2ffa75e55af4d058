#include "tracking/clock_calibration.h"

#include "../core/error_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace onestroke {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

/// A head that is shaken and nods by `swing` degrees, not quite regularly.
Quat head_at(double t, double swing) {
  return exp_so3({swing / 2 * degree * std::sin(4.1 * t + 1),
                  swing * degree * std::sin(5.3 * t) + swing / 3 * degree * std::sin(2.3 * t), 0.1}) *
         exp_so3({0, 0, swing / 4 * degree * std::sin(3.1 * t)});
}

struct Recording {
  double swing = 15, seconds = 12, offset_ms = 0, noise_deg = 0.1, share_wrong = 0;
  unsigned seed = 1;
};

std::vector<ClockSight> record(const Recording& r) {
  const Quat R_head_camera = exp_so3({0.3, -0.2, 0.1}), R_world_marker = exp_so3({0.5, 0.9, 0});
  std::mt19937 generator(r.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<ClockSight> sights;
  for (int i = 0; i < static_cast<int>(30 * r.seconds); ++i) {
    const double t = i / 30.0 + 0.001 * normal(generator);
    if (uniform(generator) < 0.05) continue;  // not found
    const Quat then = head_at(t + r.offset_ms * 1e-3, r.swing);
    const double off = (uniform(generator) < r.share_wrong ? 5 : r.noise_deg) * degree;
    const Quat noise = exp_so3({off * normal(generator), off * normal(generator), off * normal(generator)});
    sights.push_back({Time{} + Duration::from_seconds(t),
                      {head_at(t, r.swing), {}},
                      {noise * (then * R_head_camera).conjugate() * R_world_marker, {0, 0, 500}}});
  }
  return sights;
}

TEST(ClockOffset, IsFoundWithoutNoise) {
  for (const double ms : {-80.0, -13.7, 0.0, 4.2, 55.0, 120.0}) {
    const ClockOffset found = find_clock_offset(record({.offset_ms = ms, .noise_deg = 0}));
    // What the cubic leaves of the head's path between pictures.
    EXPECT_NEAR(found.offset.ms(), ms, 0.05) << ms;
    EXPECT_LT(found.residual_deg, 0.02);
  }
}

TEST(ClockOffset, ItsDeviationIsHonest) {
  double sum = 0, worst = 0, deviations = 0;
  constexpr int draws = 60;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const ClockOffset found = find_clock_offset(record({.offset_ms = -22.5, .noise_deg = 0.15, .seed = seed}));
    const double error = found.offset.ms() + 22.5;
    sum += std::pow(error / found.deviation.ms(), 2);
    worst = std::max(worst, std::abs(error));
    deviations += found.deviation.ms() / draws;
  }
  RecordProperty("normalised_error_squared", std::to_string(sum / draws));
  RecordProperty("deviation_ms", std::to_string(deviations));
  EXPECT_GT(sum / draws, 0.4);
  EXPECT_LT(sum / draws, 2.2);
  EXPECT_LT(worst, 1);
  EXPECT_LT(deviations, 0.4);
}

TEST(ClockOffset, WrongPosesCountForNothing) {
  const ClockOffset found = find_clock_offset(record({.offset_ms = 31, .share_wrong = 0.1}));
  EXPECT_NEAR(found.offset.ms(), 31, 0.6);
}

TEST(ClockOffset, SaysWhatIsMissing) {
  EXPECT_THAT(error_of([] { find_clock_offset({}); }), HasSubstr("too few"));
  EXPECT_THAT(error_of([] { find_clock_offset(record({.seconds = 1.5})); }), HasSubstr("too few"));
  EXPECT_THAT(error_of([] { find_clock_offset(record({.swing = 1})); }), HasSubstr("turn it to and fro"));
  EXPECT_THAT(error_of([] { find_clock_offset(record({.offset_ms = 400})); }), HasSubstr("do not agree"));
}

}  // namespace
}  // namespace onestroke
