// How well the tracker does on pictures of the synthetic renderer, where the truth is exact.

#include "synthetic_set.h"
#include "table.h"

#include <gtest/gtest.h>

#include <iostream>

namespace onestroke::accuracy {
namespace {

/// The most that each figure may be, and the least that must be found.
struct Demand {
  const char* group;
  double found_pct;
  double rotation_median, rotation_p95, rotation_max;
  double distance_median, distance_p95, distance_max;
};

void PrintTo(const Demand& d, std::ostream* out) {
  *out << d.group;
}

class Synthetic : public ::testing::TestWithParam<Demand> {};

TEST_P(Synthetic, MeetsItsDemands) {
  const Demand demand = GetParam();
  const Score score = measure(synthetic_catalog(), [&](const Visit& visit) { draw_synthetic(demand.group, visit); });
  print_table_head(std::cout);
  print_table_row(std::cout, demand.group, score);
  print_failures(std::cout, score);
  EXPECT_GE(score.found_pct(), demand.found_pct);
  EXPECT_TRUE(score.wrong.empty());
  EXPECT_EQ(score.flips, 0);
  EXPECT_LE(quantile(score.rotation_deg, 0.5), demand.rotation_median);
  EXPECT_LE(quantile(score.rotation_deg, 0.95), demand.rotation_p95);
  EXPECT_LE(quantile(score.rotation_deg, 1), demand.rotation_max);
  EXPECT_LE(quantile(score.distance_pct, 0.5), demand.distance_median);
  EXPECT_LE(quantile(score.distance_pct, 0.95), demand.distance_p95);
  EXPECT_LE(quantile(score.distance_pct, 1), demand.distance_max);
}

// Where an arm points at the camera little but its tip shows of it, and the roll about the other arm can hardly be
// told: near 90 and 270 degrees about x and y the marker is not reported at every distance.
INSTANTIATE_TEST_SUITE_P(Sweep, Synthetic,
                         ::testing::Values(Demand{"turn about x", 85, 0.04, 0.25, 1, 0.02, 0.08, 0.12},
                                           Demand{"turn about y", 90, 0.04, 0.25, 1, 0.02, 0.08, 0.12},
                                           Demand{"turn about z", 100, 0.08, 0.3, 0.8, 0.02, 0.08, 0.12},
                                           Demand{"any orientation", 95, 0.02, 0.15, 0.6, 0.01, 0.04, 0.1}));

}  // namespace
}  // namespace onestroke::accuracy
