#include "scene/compare_menu.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace onestroke {
namespace {

constexpr double frame_ms = 10;

std::size_t entry_of(char key) {
  return static_cast<std::size_t>(std::ranges::find(menu_entries, key, &MenuEntry::key) - menu_entries.begin());
}

/// A menu that was opened by hands in front of a camera that stands somewhere, and what was picked from it.
class CompareMenuTest : public testing::Test {
 protected:
  CompareMenuTest() { open({0, 40, 400}); }
  void open(Vec3 place_in_camera) {
    menu_.open(camera_ * place_in_camera, camera_, now());
    set_entries();
  }
  void set_entries() {
    for (std::size_t i = 0; i < menu_entries.size(); ++i)
      menu_.set_entry(i, {menu_entries[i].words, i != not_offered_});
  }
  void point(const std::function<std::optional<Vec3>(double since_ms)>& tip, double ms) {
    for (double t = 0; t < ms; t += frame_ms, now_ms_ += frame_ms) {
      set_entries();
      if (const auto key = menu_.update(tip(t), camera_.translation, Duration::from_ms(frame_ms), now()))
        picked_ += *key;
    }
  }
  void point(const std::optional<Vec3>& tip, double ms) {
    point([&](double) { return tip; }, ms);
  }
  /// Where a tip covers an entry, so much nearer to the eye than the menu.
  Vec3 before(std::size_t entry, double nearer_mm = 0, Vec3 off = {}) const {
    const Vec3 on = inverse(camera_) * (menu_.view().T_world_menu * (MenuView::place_of(entry) + off));
    return camera_ * ((on.z - nearer_mm) / on.z * on);
  }
  Vec3 outside() const { return menu_.view().T_world_menu * Vec3{0, 90, 0}; }
  Time now() const { return Time{} + Duration::from_ms(now_ms_); }

  const Pose camera_{exp_so3({0.2, 2, 0.1}), {100, 200, 300}};
  CompareMenu menu_;
  std::size_t not_offered_ = menu_entries.size();
  std::string picked_;
  double now_ms_ = 1000;
};

TEST_F(CompareMenuTest, HangsWhereTheCameraSeesAllOfIt) {
  const double across = std::tan(0.5), down = across * 9 / 16;
  for (const Vec3 place : {Vec3{0, 0, 400}, {-200, 130, 350}, {250, -150, 500}, {0, 300, 900}, {10, 20, 60}}) {
    open(place);
    const Pose T_camera_menu = inverse(camera_) * menu_.view().T_world_menu;
    for (std::size_t i = 0; i < menu_entries.size(); ++i) {
      const Vec3 p = T_camera_menu * MenuView::place_of(i);
      EXPECT_LT(std::abs(p.x) + CompareMenu::cell_width / 2, across * p.z);
      EXPECT_LT(std::abs(p.y) + CompareMenu::cell_height / 2, 1.1 * down * p.z);
      EXPECT_LT(norm(p), 650);
    }
  }
}

TEST_F(CompareMenuTest, AnEntryIsPickedByATipThatIsHeldBeforeIt) {
  for (std::size_t i = 0; i < menu_entries.size(); ++i) {
    if (i == CompareMenu::leave_entry) continue;
    open({0, 40, 400});
    point(outside(), 100);
    picked_.clear();
    point(before(i), 990);
    EXPECT_EQ(picked_, "");
    EXPECT_EQ(menu_.view().pointed, i);
    EXPECT_NEAR(menu_.view().progress, 0.98, 0.02);
    point(before(i), 1000);
    EXPECT_EQ(picked_, std::string(1, menu_entries[i].key));
    EXPECT_FALSE(menu_.is_open());
  }
}

TEST_F(CompareMenuTest, HowDeepTheTipIsDoesNotMatter) {
  for (const double nearer : {-150.0, 150.0}) {
    open({0, 40, 400});
    point(outside(), 100);
    picked_.clear();
    point(before(entry_of('m'), nearer), 1010);
    EXPECT_EQ(picked_, "m") << nearer;
  }
}

TEST_F(CompareMenuTest, LeavingAsksOnceMoreElsewhere) {
  point(outside(), 100);
  point(before(CompareMenu::leave_entry), 4000);
  EXPECT_EQ(picked_, "");
  EXPECT_TRUE(menu_.is_open());
  EXPECT_EQ(menu_.view().entries[CompareMenu::leave_entry].words, "Stay");
  EXPECT_EQ(menu_.view().entries[CompareMenu::sure_entry].words, "Leave");
  EXPECT_FALSE(menu_.view().pointed) << "what is there now was not meant";
  for (const MenuEntryView& entry : menu_.view().entries)
    EXPECT_EQ(entry.offered, entry.words == "Leave" || entry.words == "Stay") << entry.words;
  point(before(entry_of('r')), 1500);
  EXPECT_EQ(picked_, "");
  point(before(CompareMenu::sure_entry), 1900);
  EXPECT_EQ(picked_, "");
  point(before(CompareMenu::sure_entry), 200);
  EXPECT_EQ(picked_, "q");
  EXPECT_FALSE(menu_.is_open());
}

TEST_F(CompareMenuTest, ThereIsAWayToStay) {
  point(outside(), 100);
  point(before(CompareMenu::leave_entry), 1100);
  point(outside(), 100);
  point(before(CompareMenu::leave_entry), 1100);
  EXPECT_EQ(picked_, "");
  EXPECT_FALSE(menu_.is_open());
  open({0, 40, 400});
  point(outside(), 100);
  point(before(entry_of('l')), 1100);
  EXPECT_EQ(picked_, "l") << "all is as before";
}

TEST_F(CompareMenuTest, WhatATipMeetsWhenTheMenuComesIsNotMeant) {
  point(before(entry_of('p')), 4000);
  EXPECT_EQ(picked_, "");
  EXPECT_FALSE(menu_.view().pointed);
  point(before(entry_of('p'), 0, {15, 0, 0}), 2000);
  EXPECT_EQ(picked_, "");
  point(before(entry_of('p'), 0, {25, 0, 0}), 1100);
  EXPECT_EQ(picked_, "p");
}

TEST_F(CompareMenuTest, AShortGapIsForgivenAndALongOneIsNot) {
  for (const double gap : {200.0, 400.0}) {
    open({0, 40, 400});
    point(outside(), 100);
    picked_.clear();
    point(before(entry_of('c')), 700);
    point(std::nullopt, gap);
    point(before(entry_of('c')), 200);
    EXPECT_EQ(picked_.empty(), gap > 300) << gap;
  }
}

TEST_F(CompareMenuTest, ATipAtTheEdgeDoesNotFlicker) {
  point(outside(), 100);
  const Vec3 edge{CompareMenu::cell_width / 2, 0, 0};
  point(before(entry_of('l'), 0, 0.9 * edge), 50);
  // Over the edge and back at 5 Hz.
  point([&](double t) { return before(entry_of('l'), 0, (1 + 0.1 * std::sin(0.0314 * t)) * edge); }, 1000);
  EXPECT_EQ(picked_, "l");
}

TEST_F(CompareMenuTest, WhatTheModeLacksIsNotPicked) {
  not_offered_ = entry_of('b');
  point(outside(), 100);
  point(before(not_offered_), 2000);
  EXPECT_EQ(picked_, "");
  for (const char key : {'l', 'o', 'c', 'm'}) {
    menu_.go_on(now());
    EXPECT_EQ(menu_.view().pointed, entry_of(key));
  }
  EXPECT_EQ(menu_.pick(now()), 'm');
}

TEST_F(CompareMenuTest, ClosesWhenItIsNotUsed) {
  point(outside(), 9900);
  EXPECT_TRUE(menu_.is_open());
  point(before(entry_of('c')), 100);
  point(outside(), 9900);
  EXPECT_TRUE(menu_.is_open());
  menu_.go_on(now());
  point(std::nullopt, 9900);
  EXPECT_TRUE(menu_.is_open());
  EXPECT_EQ(menu_.view().amount, 1);
  point(std::nullopt, 300);
  EXPECT_FALSE(menu_.is_open());
  EXPECT_EQ(menu_.view().amount, 0);
  EXPECT_EQ(menu_.pick(now()), std::nullopt);
}

}  // namespace
}  // namespace onestroke
