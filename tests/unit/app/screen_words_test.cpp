#include "app/label_layout.h"
#include "app/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace onestroke {
namespace {

constexpr Viewport viewport{0, 0, 1280, 720};

View view_of(const Pose& T_world_view = {}) {
  const Intrinsics k = Intrinsics::from_fov(1280, 720, 1);
  return {T_world_view, fov_of(k, 1280, 720), viewport};
}

struct Spot {
  double u = 0, v = 0;
};

Spot seen(const View& view, Vec3 world) {
  const Vec3 p = inverse(view.T_world_view) * world;
  const double focal = view.viewport.height / (view.fov.up - view.fov.down);
  return {(p.x / p.z - view.fov.left) * focal, (p.y / p.z + view.fov.up) * focal};
}

std::array<std::optional<LabelPlace>, 2> places(const View& view, LabelWish a, LabelWish b) {
  std::array<std::optional<LabelPlace>, 2> result;
  place_labels(view, std::array{a, b}, result);
  return result;
}

TEST(TextSize, IsADegreeOfVisualAngleAtLeast) {
  for (const double fov_deg : {40.0, 60.0, 90.0, 110.0})
    for (const int height : {480, 720, 2000}) {
      const View view{
          .T_world_view = {},
          .fov = fov_of(Intrinsics::from_fov(height, height, fov_deg * std::numbers::pi / 180), height, height),
          .viewport = {0, 0, height, height}};
      const double seen = std::atan(pixel_at(view, 1) * text_em(view));
      EXPECT_GE(seen * 180 / std::numbers::pi, 1 - 1e-9) << fov_deg << " degrees, " << height << " pixels";
    }
}

TEST(CardLayout, StandsBesideItsBallWhereThereIsRoom) {
  const View view = view_of();
  const LabelWish left{"Bracket v1\nmaterial: steel", {-90, 0, 400}, 40}, right{left.text, {150, 0, 400}, 40};
  EXPECT_TRUE(card_fits_right(view, left, true));
  EXPECT_FALSE(card_fits_right(view, left, false)) << "both sides have room";
  EXPECT_FALSE(card_fits_right(view, right, true)) << "only the left one has";
  const double reach = 40.0 / 400 * 720 / (view.fov.up - view.fov.down);
  EXPECT_GT(seen(view, place_card(view, left, true).position_world).u, seen(view, left.centre_world).u + reach);
  EXPECT_LT(seen(view, place_card(view, right, false).position_world).u, seen(view, right.centre_world).u - reach);
  // Inside the view, also where it is asked to the side without room.
  EXPECT_GT(seen(view, place_card(view, {left.text, {-300, -200, 400}, 40}, false).position_world).u, 0);
}

TEST(LabelLayout, StandsAboveWhatItNames) {
  const View view = view_of({exp_so3({0.1, -0.4, 0.2}), {30, -20, 10}});
  const Vec3 left = view.T_world_view * Vec3{-90, 0, 450}, right = view.T_world_view * Vec3{90, 10, 450};
  const auto [a, b] = places(view, {"left", left, 50}, {"right", right, 50});
  ASSERT_TRUE(a && b);
  const double reach_px = 50.0 / 450 * 720 / (view.fov.up - view.fov.down);
  EXPECT_NEAR(seen(view, a->position_world).u, seen(view, left).u, 0.01);
  EXPECT_LT(seen(view, a->position_world).v, seen(view, left).v - reach_px);
  EXPECT_GT(seen(view, a->position_world).v, seen(view, left).v - reach_px - 40);
  EXPECT_LT(norm(a->leader_world - left), 50);
  EXPECT_NEAR(seen(view, a->leader_world).u, seen(view, left).u, 0.01);
}

TEST(LabelLayout, StaysInsideTheView) {
  const View view = view_of();
  for (const Vec3 at : {Vec3{-1000, -900, 450}, Vec3{1000, -900, 450}, Vec3{1000, 900, 450}, Vec3{0, -200, 450}}) {
    const auto [a, b] = places(view, {"bracket v1 (predicted)", at, 50}, {"", {0, 0, -100}, 50});
    ASSERT_TRUE(a);
    EXPECT_FALSE(b) << "behind the view";
    const Spot spot = seen(view, a->position_world);
    EXPECT_GE(spot.u, 60);
    EXPECT_LE(spot.u, 1220);
    EXPECT_GE(spot.v, 30);
    EXPECT_LE(spot.v, 720);
  }
}

TEST(LabelLayout, MakesRoomWithoutJumps) {
  const View view = view_of();
  std::optional<Spot> before;
  for (double apart = 300; apart >= -300; apart -= 0.5) {
    const auto [a, b] = places(view, {"bracket v1", {-apart / 2, 0, 450}, 45}, {"bracket v2", {apart / 2, 2, 450}, 45});
    const Spot one = seen(view, a->position_world), two = seen(view, b->position_world);
    const bool overlap = std::abs(one.u - two.u) < 90 && std::abs(one.v - two.v) < 25;
    EXPECT_FALSE(overlap) << apart;
    const double moved = before ? std::hypot(one.u - before->u, one.v - before->v) : 0;
    EXPECT_LT(moved, 4) << apart;
    before = one;
  }
}

}  // namespace
}  // namespace onestroke
