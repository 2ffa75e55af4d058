// The tracker on pictures of another renderer; run where ONESTROKE_PHOTOREAL names their folder.

#include "photoreal_set.h"
#include "table.h"

#include <gtest/gtest.h>

#include <iostream>

namespace onestroke::accuracy {
namespace {

/// What the tracker must reach on one group.
struct Demand {
  const char* group;
  double found_pct;
  double rotation_deg, distance_pct;          ///< The largest errors.
  double rotation_p95_deg, distance_p95_pct;  ///< At 95 % of the markers found.
};

void PrintTo(const Demand& d, std::ostream* out) {
  *out << d.group;
}

class Photoreal : public ::testing::TestWithParam<Demand> {};

TEST_P(Photoreal, MeetsItsDemands) {
  const Demand demand = GetParam();
  const PhotorealSet set(photoreal_folder());
  const Score score = measure(set.catalog(), [&](const Visit& visit) { set.visit(demand.group, visit); });
  print_table_head(std::cout);
  print_table_row(std::cout, demand.group, score);
  print_failures(std::cout, score);
  ASSERT_GT(score.pictures, 0);
  EXPECT_GE(score.found_pct(), demand.found_pct);
  EXPECT_TRUE(score.wrong.empty());
  EXPECT_LE(quantile(score.rotation_deg, 1), demand.rotation_deg);
  EXPECT_LE(quantile(score.distance_pct, 1), demand.distance_pct);
  EXPECT_LE(quantile(score.rotation_deg, 0.95), demand.rotation_p95_deg);
  EXPECT_LE(quantile(score.distance_pct, 0.95), demand.distance_p95_pct);
}

// What counts as found is within 10 degrees and 5 %.
INSTANTIATE_TEST_SUITE_P(Groups, Photoreal,
                         ::testing::Values(Demand{"booth", 100, 0.2, 0.15, 0.2, 0.15},
                                           Demand{"sphere", 99, 1.5, 1, 0.5, 0.3}, Demand{"hands", 97, 10, 5, 0.7, 0.4},
                                           Demand{"turntable", 100, 0.5, 0.3, 0.5, 0.3},
                                           Demand{"hmd", 98, 10, 5, 1.2, 0.8}, Demand{"multi", 100, 1, 0.5, 1, 0.5}),
                         [](const auto& info) { return std::string(info.param.group); });

}  // namespace
}  // namespace onestroke::accuracy

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (onestroke::accuracy::photoreal_folder().empty()) {
    std::cout << onestroke::accuracy::photoreal_missing << '\n';
    return 0;
  }
  return RUN_ALL_TESTS();
}
