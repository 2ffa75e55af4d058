// What is believed of the fits of one marker.

#include "tracking/look_fits.h"

#include "tracking/roll_search.h"
#include "view_fixture.h"

#include <gtest/gtest.h>

namespace onestroke::test {
namespace {

/// One marker in full sight, and what judges it by its look.
class LookFitsOfOneView : public ::testing::Test {
 protected:
  LookFits fits() const { return {levels_, shot_.intrinsics, rod_, 0, truth()}; }
  EigenPose truth() const { return to_eigen(truth_); }
  EigenPose near_by() const { return to_eigen(disturbed(truth_, random_, 1, 0.5)); }
  double off(const EigenPose& pose) const { return turn_between(from_eigen(pose), truth_); }

  mutable RandomPose random_;
  MarkerSpec marker_ = angle_marker(2);
  RodModel rod_{marker_};
  Pose truth_ = random_view(random_);
  Shot shot_ = shoot(marker_, truth_, {.seed = 1});
  Levels levels_{shot_.view(), shot_.view(), shot_.view()};
  Inks inks_ = inks_at(shot_, rod_, truth_);
};

TEST_F(LookFitsOfOneView, AreBelievedWhereTheRodIsInFullSight) {
  LookFits f = fits();
  f.add(near_by(), inks_);
  ASSERT_EQ(f.all().size(), 1U);
  const Detection d = f.measure();
  EXPECT_LT(off(d.refinement.pose), 0.3);
  EXPECT_FALSE(LookFits::contradicted(d.appearance));
  EXPECT_TRUE(f.believed(d));
}

TEST_F(LookFitsOfOneView, TellTheirMirrorImageApartInAContest) {
  LookFits f = fits();
  f.add(near_by(), inks_);
  LookFit other = f.best();
  other.pose = mirrored(rod_, other.pose);
  ASSERT_GT(angle_between(other.pose, f.best().pose), LookFits::apart);
  f.add_measured(other);
  ASSERT_TRUE(f.contest());
  // Fitted near, the other way turns out to be none.
  EXPECT_LT(off(f.best().pose), 0.3);
  EXPECT_TRUE(f.believed(f.measure()));
}

TEST_F(LookFitsOfOneView, AreContradictedByAnotherCodesRings) {
  const MarkerSpec other = angle_marker(5);
  const Appearance wrong = assess(shot_.view(), shot_.intrinsics, RodModel(other), inks_, truth());
  EXPECT_TRUE(LookFits::contradicted(wrong));
  const Appearance right = assess(shot_.view(), shot_.intrinsics, rod_, inks_, truth());
  EXPECT_FALSE(LookFits::contradicted(right));
}

TEST_F(LookFitsOfOneView, StayWhereAllOfThemAreContradicted) {
  const MarkerSpec other = angle_marker(5);
  const RodModel rod(other);
  LookFits f(levels_, shot_.intrinsics, rod, 0, truth());
  f.add(truth(), inks_);
  const std::size_t before = f.all().size();
  f.drop_contradicted();
  EXPECT_EQ(f.all().size(), before);
  EXPECT_TRUE(f.all().empty() || !f.believed(f.measure()));
}

TEST_F(LookFitsOfOneView, OfOneTurnAreKept) {
  LookFits f = fits();
  f.add(near_by(), inks_);
  EXPECT_TRUE(f.keep_like(truth()));
  EXPECT_FALSE(f.keep_like(mirrored(rod_, truth())));
  EXPECT_TRUE(f.all().empty());
}

}  // namespace
}  // namespace onestroke::test
