#include "scene/hands.h"

#include "sticks.h"

#include <gtest/gtest.h>

namespace onestroke {
namespace {

Time at_ms(double ms) {
  return Time{} + Duration::from_ms(ms);
}

Stick stick(int id, double x, double z = 400) {
  return {.id = id, .place = {x, 0, z}};
}

TEST(Hands, TheSideOfThePictureDecides) {
  Hands hands;
  hands.update(record_of({stick(7, 80), stick(3, -60)}), at_ms(0));
  EXPECT_EQ(hands[Hand::left].id, 3);
  EXPECT_EQ(hands[Hand::right].id, 7);
}

TEST(Hands, TwoOnOneSideAreToldApartByEachOther) {
  Hands hands;
  hands.update(record_of({stick(1, 150), stick(2, 90)}), at_ms(0));
  EXPECT_EQ(hands[Hand::left].id, 2);
  EXPECT_EQ(hands[Hand::right].id, 1);
}

TEST(Hands, ASingleStickGoesToItsSideAndTheNextToTheOther) {
  Hands hands;
  hands.update(record_of({stick(5, 40)}), at_ms(0));
  EXPECT_EQ(hands[Hand::right].id, 5);
  EXPECT_FALSE(hands[Hand::left].held);
  hands.update(record_of({stick(5, 40), stick(6, 60)}), at_ms(16));
  EXPECT_EQ(hands[Hand::right].id, 5);
  EXPECT_EQ(hands[Hand::left].id, 6);
}

TEST(Hands, CrossingForAMomentExchangesNothing) {
  Hands hands;
  for (int ms = 0; ms < 3000; ms += 10) {
    // Across and back within a second and a half, the far side held for less than the time it takes to exchange.
    const double x = ms < 1000 || ms > 1700 ? -100 : 100;
    EXPECT_FALSE(hands.update(record_of({stick(1, x), stick(2, -x)}), at_ms(ms)));
    EXPECT_EQ(hands[Hand::left].id, 1) << ms;
  }
}

TEST(Hands, TremblingAtTheSamePlaceExchangesNothing) {
  Hands hands;
  hands.update(record_of({stick(1, -10), stick(2, 10)}), at_ms(0));
  for (int ms = 10; ms < 5000; ms += 10) {
    const double x = ms % 20 == 0 ? 15 : -15;
    EXPECT_FALSE(hands.update(record_of({stick(1, x), stick(2, -x)}), at_ms(ms)));
  }
}

TEST(Hands, StayingCrossedExchangesThemOnce) {
  Hands hands;
  hands.update(record_of({stick(1, -100), stick(2, 100)}), at_ms(0));
  int exchanges = 0;
  for (int ms = 10; ms < 4000; ms += 10)
    exchanges += hands.update(record_of({stick(1, 100), stick(2, -100)}), at_ms(ms)) ? 1 : 0;
  EXPECT_EQ(exchanges, 1);
  EXPECT_EQ(hands[Hand::left].id, 2);
  EXPECT_EQ(hands[Hand::right].id, 1);
}

TEST(Hands, AStickOutOfSightKeepsItsHandForAWhile) {
  Hands hands;
  hands.update(record_of({stick(1, -100), stick(2, 100)}), at_ms(0));
  hands.update(record_of({stick(2, 100)}), at_ms(1000));
  EXPECT_EQ(hands[Hand::left].id, 1);
  EXPECT_EQ(hands[Hand::left].state, MarkerState::lost);
  // A third stick does not push it out.
  hands.update(record_of({stick(2, 100), stick(3, -80)}), at_ms(1400));
  EXPECT_EQ(hands[Hand::left].id, 1);
  hands.update(record_of({stick(2, 100), stick(3, -80)}), at_ms(1600));
  EXPECT_EQ(hands[Hand::left].id, 3);
}

TEST(Hands, TheNearestOfManyAreHeld) {
  Hands hands;
  hands.update(record_of({stick(1, -200, 900), stick(2, 100, 300), stick(3, 0, 800), stick(4, -50, 350)}), at_ms(0));
  EXPECT_EQ(hands[Hand::left].id, 4);
  EXPECT_EQ(hands[Hand::right].id, 2);
}

TEST(Hands, TheWorldPoseTakesTheHeadIntoAccount) {
  Hands hands;
  FrameRecord record = record_of({stick(1, -100)});
  record.T_world_camera = {from_euler_xyz(0, 1, 0), {5, 6, 7}};
  hands.update(record, at_ms(0));
  const Vec3 expected = record.T_world_camera * Vec3{-100, 0, 400};
  EXPECT_NEAR(norm(hands[Hand::left].T_world_marker.translation - expected), 0, 1e-9);
}

TEST(Hands, ExchangedOnPurposeStayExchanged) {
  Hands hands;
  const FrameRecord record = record_of({stick(1, -100), stick(2, 100)});
  EXPECT_FALSE(hands.exchange());
  hands.update(record, at_ms(0));
  EXPECT_TRUE(hands.exchange());
  for (int ms = 10; ms < 3000; ms += 10) EXPECT_FALSE(hands.update(record, at_ms(ms)));
  EXPECT_EQ(hands[Hand::left].id, 2);
  // And are changed back by crossing them.
  const FrameRecord crossed = record_of({stick(1, 100), stick(2, -100)});
  int changed = 0;
  for (int ms = 3000; ms < 5000; ms += 10) changed += hands.update(crossed, at_ms(ms)) ? 1 : 0;
  EXPECT_EQ(changed, 1);
  EXPECT_EQ(hands[Hand::left].id, 1);
}

TEST(Hands, AThirdStickWaitsUntilAHandIsFree) {
  Hands hands;
  hands.update(record_of({stick(1, -100), stick(2, 100)}), at_ms(0));
  // Nearer than the other two, and between them.
  Stick third = stick(3, 0);
  third.place.z = 250;
  int ms = 10;
  for (; ms < 2000; ms += 10) hands.update(record_of({stick(1, -100), stick(2, 100), third}), at_ms(ms));
  EXPECT_EQ(hands[Hand::left].id, 1);
  EXPECT_EQ(hands[Hand::right].id, 2);
  for (; ms < 4000; ms += 10) hands.update(record_of({stick(1, -100), third}), at_ms(ms));
  EXPECT_EQ(hands[Hand::left].id, 1);
  EXPECT_EQ(hands[Hand::right].id, 3);
}

}  // namespace
}  // namespace onestroke
