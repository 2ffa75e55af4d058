#include "allocation/allocation_counter.h"
#include "scene/comparison.h"
#include "sticks.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

TEST(ComparisonAllocation, NoFrameAllocates) {
  const std::array carried{CarriedModel{1, Text("bracket_v1")}, CarriedModel{2, Text("bracket_v2")}};
  Comparison comparison(carried);
  Stick left{.id = 1, .place = {-100, 0, 400}}, right{.id = 2, .place = {100, 0, 400}};
  const long before = test::allocations_of_this_thread();
  for (int ms = 0; ms < 6000; ms += 10) {
    // Every mode is entered and left.
    constexpr std::string_view keys = "llloobbccmmffpixx";
    if (ms % 100 == 0) comparison.press(keys[static_cast<std::size_t>(ms) / 100 % keys.size()]);
    left.place.x = ms > 2000 && ms < 3000 ? 80 : -100;
    right.state = ms > 4000 ? MarkerState::lost : MarkerState::measured;
    right.rotation = exp_so3({0, 0.03, 0}) * right.rotation;
    comparison.update(record_of({left, right}), Time{} + Duration::from_ms(ms));
  }
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace onestroke
