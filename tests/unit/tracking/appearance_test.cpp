#include "tracking/appearance.h"

#include "scene_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace onestroke::test {
namespace {

struct Scene {
  MarkerSpec marker = angle_marker(3);
  RodModel rod{marker};
  Pose truth = about_middle(exp_so3({0.3, -0.4, 0.2}), {5, -8, 350});
  Shot shot = shoot(marker, truth);

  Inks learnt() const {
    Inks inks;
    complete_inks(shot.view(), shot.intrinsics, rod, to_eigen(truth), inks);
    return inks;
  }
  Appearance at(const Pose& pose) const { return assess(shot.view(), shot.intrinsics, rod, learnt(), to_eigen(pose)); }
};

TEST(Appearance, InksAreLearntFromThePicture) {
  const Inks inks = Scene().learnt();
  for (int ink = 0; ink < 3; ++ink) {
    ASSERT_TRUE(inks.known[static_cast<std::size_t>(ink)]);
    int strongest = 0;
    inks.chroma[static_cast<std::size_t>(ink)].maxCoeff(&strongest);
    EXPECT_EQ(strongest, ink);
  }
  EXPECT_GT(inks.separation, 0.1F);
}

TEST(Appearance, AKnownInkIsLeftAsItIs) {
  const Scene scene;
  Inks inks;
  inks.set(1, {0.2F, 0.5F, 0.3F});
  complete_inks(scene.shot.view(), scene.shot.intrinsics, scene.rod, to_eigen(scene.truth), inks);
  EXPECT_EQ(inks.chroma[1][1], 0.5F);
  EXPECT_TRUE(inks.known[0] && inks.known[2]);
}

TEST(Appearance, AtTheTruePoseEveryCellAgrees) {
  const Scene scene;
  const Appearance a = scene.at(scene.truth);
  EXPECT_EQ(a.in_sight, 36);
  EXPECT_EQ(a.agrees, 36);
  EXPECT_EQ(a.contradicts, 0);
  EXPECT_EQ(a.fewest_on_arm, 18);
  EXPECT_EQ(a.weakest_share, 1);
  EXPECT_EQ(a.evidence(), 36);
  ASSERT_EQ(a.cells.size(), 36u);
  for (const CellCentre& c : a.cells) {
    // The front of the cell stands before its axis, seen in nearly the same place.
    Vec2d pixel;
    ASSERT_TRUE(project(scene.shot.intrinsics, to_eigen(scene.truth) * scene.rod.middle(c.index).centre, pixel));
    EXPECT_LT(std::hypot(c.u - pixel.x(), c.v - pixel.y()), 9) << c.index;
  }
}

TEST(Appearance, AShiftOfOneCellContradicts) {
  const Scene scene;
  const Appearance a = scene.at(scene.truth * Pose{{}, {4, 0, 0}});
  EXPECT_GT(a.contradicts, 12);
  EXPECT_LT(a.evidence(), 0);
}

TEST(Appearance, ARodThatRollsAboutOneArmShowsThatArmAlone) {
  const Scene scene;
  const Appearance a = scene.at(scene.truth * Pose{exp_so3({0, 0.6, 0}), {}});
  EXPECT_GE(a.agrees, 16);
  EXPECT_LE(a.fewest_on_arm, 4);
  EXPECT_LT(a.weakest_share, 0.35);
}

TEST(Appearance, NothingIsInSightBesideThePictureOrBehindTheCamera) {
  const Scene scene;
  for (const Vec3 far : {Vec3{2000, 0, 350}, Vec3{0, 0, -350}}) {
    const Appearance a = scene.at(about_middle({}, far));
    EXPECT_EQ(a.in_sight, 0);
    EXPECT_TRUE(a.cells.empty());
  }
}

TEST(Appearance, CellsBehindTheRodItselfAreNotInSight) {
  const MarkerSpec marker = angle_marker(3);
  // The camera looks along the plane of the arms, past the start arm at the stop arm.
  const Vec3 towards_eye = normalized(Vec3{-1, -0.4, 0});
  const Pose pose = about_middle(exp_so3(std::numbers::pi / 2 * cross(towards_eye, {0, 0, -1})), {0, 0, 350});
  const Shot shot = shoot(marker, pose);
  const RodModel rod(marker);
  Inks inks;
  complete_inks(shot.view(), shot.intrinsics, rod, to_eigen(pose), inks);
  const Appearance a = assess(shot.view(), shot.intrinsics, rod, inks, to_eigen(pose));
  EXPECT_LT(a.in_sight, 24) << "the stop arm is hidden";
  EXPECT_LE(a.contradicts, 1);
  EXPECT_GE(a.agrees, 17);
}

}  // namespace
}  // namespace onestroke::test
