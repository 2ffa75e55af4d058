// The first look at a picture, and that it knows what it leaves to a thorough one.

#include "tracking/quick_search.h"

#include "scene_fixture.h"

#include <gtest/gtest.h>

namespace onestroke::test {
namespace {

struct Looker {
  Catalog catalog;
  std::vector<RodModel> rods;
  QuickSearch search;

  explicit Looker(int markers) : catalog(catalog_of(markers)), rods(rods_of(catalog)), search(catalog, rods) {}

  static std::vector<RodModel> rods_of(const Catalog& catalog) {
    std::vector<RodModel> rods;
    for (const MarkerSpec& m : catalog.markers) rods.emplace_back(m);
    return rods;
  }

  /// Whether rows are left that nothing explains.
  bool look(const Shot& shot, std::vector<Detection>& found, const std::vector<bool>& skip = {},
            QuickSearch::Detail detail = QuickSearch::Detail::coarse) {
    found.clear();
    search.find({shot.view(), shot.intrinsics, {}}, detail, skip, {}, found);
    return !search.unexplained().empty();
  }
};

const Pose left = about_middle(exp_so3({0.3, -0.2, 0.4}), {-45, 0, 420});
const Pose right = about_middle(exp_so3({-0.3, 0.2, 2.2}), {45, 0, 420});

TEST(QuickSearch, FindsWhatStandsInPlainView) {
  Looker looker(6);
  const Shot shot = shoot({{&looker.catalog.markers[1], left}, {&looker.catalog.markers[4], right}});
  std::vector<Detection> found;
  EXPECT_FALSE(looker.look(shot, found)) << "nothing is left";
  ASSERT_EQ(found.size(), 2u);
  for (const Detection& d : found) {
    const Pose& truth = d.marker == 1 ? left : right;
    EXPECT_TRUE(d.marker == 1 || d.marker == 4);
    EXPECT_LT(turn_between(from_eigen(d.refinement.pose), truth), 1);
    EXPECT_LT(shift_between(from_eigen(d.refinement.pose), truth), 3e-3);
  }
}

TEST(QuickSearch, LeavesOutWhatItIsToldTo) {
  Looker looker(6);
  const Shot shot = shoot({{&looker.catalog.markers[1], left}, {&looker.catalog.markers[4], right}});
  std::vector<Detection> found;
  EXPECT_TRUE(looker.look(shot, found, {false, true, false, false, false, false})) << "rows that nothing explains";
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().marker, 4);
}

TEST(QuickSearch, AStrangersRowsAreLeftUnnamed) {
  Looker looker(3);
  const MarkerSpec stranger = angle_marker(9);
  std::vector<Detection> found;
  EXPECT_TRUE(looker.look(shoot(stranger, left), found));
  EXPECT_TRUE(found.empty());
}

TEST(QuickSearch, SeesNothingWhereNothingIs) {
  Looker looker(3);
  std::vector<Detection> found;
  EXPECT_FALSE(looker.look(shoot(std::vector<Placed>{}), found));
  EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace onestroke::test
