#include "display/held_world.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_NEAR(norm(a.translation - b.translation), 0, 1e-9);
  EXPECT_NEAR(angle_between(a.rotation, b.rotation), 0, 1e-7);
}

TEST(HeldWorld, WhatStandsStillStaysWhereItIsWhenItsSpaceMoves) {
  const Pose T_world_space{exp_so3({0, 0.4, 0}), {100, 1600, -30}}, T_space_head{exp_so3({0.1, 0.2, 0}), {5, -6, 7}};
  HeldWorld world;
  world.place(T_world_space);
  const Pose T_world_head = world.T_world_space(0) * T_space_head;
  // Twice: the runtime sees the head from another origin, each time from a time on.
  const Pose first{exp_so3({0, -1.2, 0}), {300, 0, 400}}, second{exp_so3({0, 0.5, 0}), {-20, 10, 0}};
  world.move(1000, first);
  expect_same(world.T_world_space(999) * T_space_head, T_world_head);
  expect_same(world.T_world_space(1000) * (inverse(first) * T_space_head), T_world_head);
  world.move(2000, second);
  expect_same(world.T_world_space(1999) * (inverse(first) * T_space_head), T_world_head);
  expect_same(world.T_world_space(2000) * (inverse(first * second) * T_space_head), T_world_head);
}

}  // namespace
}  // namespace onestroke
