// The menu in a comparison: opened by crossed arms or a key, and what is picked from it.
#include "compared_sticks.h"
#include "noisy_session.h"

#include <cstdio>
#include <map>

namespace onestroke {
namespace {

using testing::ElementsAre;

Vec3 world_place(const MenuView& menu, char key) {
  const auto entry = std::ranges::find(menu_entries, key, &MenuEntry::key) - menu_entries.begin();
  return menu.T_world_menu * MenuView::place_of(static_cast<std::size_t>(entry));
}

/// Hands whose start arms cross, and part again.
class ComparisonMenu : public ComparisonModes {
 protected:
  void cross() {
    apart_ = right_;
    right_.rotation = left_.rotation * exp_so3({0, 0, -90 * degree});
    const Vec3 middle{0, -arm / 2, 0};
    right_.place = pose(left_) * (middle - Vec3{0, 0, 8}) - rotate(right_.rotation, middle);
  }
  void part() { right_ = apart_; }
  void open() {
    run(300);
    cross();
    run(1000);
    part();
    run(200);
  }
  void point(char key, double ms) {
    right_.place = world_place(view().menu, key) - rotate(right_.rotation, stick_points[0]);
    run(ms, [this](double) { keep(); });
    keep();
  }
  /// What was asked for in the frame before.
  void keep() {
    if (view().asked_key) asked_ += view().asked_key;
  }

  Stick apart_;
  std::string asked_;
};

TEST_F(ComparisonMenu, OpensWithArmsThatCross) {
  run(300);
  cross();
  run(500);
  ASSERT_TRUE(view().offer);
  EXPECT_EQ(view().offer->words, "Menu");
  EXPECT_EQ(view().menu.amount, 0);
  run(600);
  EXPECT_EQ(view().menu.amount, 1);
  EXPECT_THAT(events_, ElementsAre("Menu"));
  // Nothing is picked before they part.
  run(4000);
  EXPECT_FALSE(view().menu.pointed);
}

TEST_F(ComparisonMenu, ClosesWithArmsThatCrossAgain) {
  open();
  cross();
  run(600);
  ASSERT_TRUE(view().offer);
  EXPECT_EQ(view().offer->words, "Close the menu");
  run(1000);
  EXPECT_EQ(view().menu.amount, 0);
  EXPECT_THAT(events_, ElementsAre("Menu", "Close the menu"));
}

TEST_F(ComparisonMenu, LeavesAndRecentresAsTheProgramIsAsked) {
  for (const char key : {'r', 'h', 'q'}) {
    asked_.clear();
    open();
    point(key, 990);
    EXPECT_EQ(asked_, "");
    point(key, 100);
    if (key == 'q') point(menu_entries[CompareMenu::sure_entry].key, 2100);
    EXPECT_EQ(asked_, std::string(1, key));
    run(500);
    EXPECT_EQ(view().menu.amount, 0);
    EXPECT_FALSE(view().asked_key) << "once";
    part();
  }
  EXPECT_THAT(events_, ElementsAre("Menu", "Recentre", "Menu", "Words", "Menu", "Leave"));
}

TEST_F(ComparisonMenu, ChangesModes) {
  open();
  point('c', 1300);
  EXPECT_EQ(view().mode.tool, Tool::section);
  part();
  open();
  const auto words = [this](char key) {
    return view().menu.entries[static_cast<std::size_t>(std::ranges::find(menu_entries, key, &MenuEntry::key) -
                                                        menu_entries.begin())];
  };
  EXPECT_EQ(words('c').words, "End the cut");
  EXPECT_FALSE(words('l').offered);
  EXPECT_TRUE(words('q').offered);
  point('c', 1300);
  EXPECT_EQ(view().mode.tool, Tool::none);
  part();
  open();
  point('x', 1300);
  EXPECT_EQ(view()[Hand::left].marker_id, 2);
  EXPECT_EQ(asked_, "");
}

TEST_F(ComparisonMenu, OtherSignsRestWhileItIsOpen) {
  open();
  hold(StickPoint::start, StickPoint::start);
  run(500);
  EXPECT_FALSE(view().offer);
  run(400);
  EXPECT_EQ(view().mode, CompareMode{});
  EXPECT_THAT(events_, ElementsAre("Menu"));
}

TEST_F(ComparisonMenu, IsGoneThroughByTwoKeysAlone) {
  left_.state = right_.state = MarkerState::lost;
  const auto press = [this](char key) {
    comparison_.press(key);
    run(frame_ms);
    keep();
  };
  press(Comparison::pick_entry);
  run(300);
  EXPECT_EQ(view().menu.amount, 1);
  EXPECT_FALSE(view().menu.pointed);
  press(Comparison::pick_entry);
  EXPECT_EQ(view().menu.amount, 1) << "nothing is pointed at";
  int pressed = 0;
  do {
    press(Comparison::next_entry);
    ASSERT_LT(++pressed, 20);
  } while (menu_entries[view().menu.pointed.value()].key != 'q');
  for (const char key : {Comparison::pick_entry, Comparison::next_entry}) press(key);
  EXPECT_EQ(asked_, "");
  press(Comparison::pick_entry);
  EXPECT_EQ(asked_, "q");
  left_.state = right_.state = MarkerState::measured;
  run(300);
  for (const char key : {Comparison::next_entry, Comparison::next_entry, Comparison::pick_entry}) press(key);
  run(50);
  EXPECT_EQ(view().mode.link, Link::same);
}

/// What the menu did in a session whose hands do what a test says.
struct Done {
  std::vector<std::string> words;
  std::string asked;

  void take(const ComparisonView& view) {
    for (const std::string_view word : view.happened()) words.emplace_back(word);
    if (view.asked_key) asked += view.asked_key;
  }
};

// When the hand leaves each place on its way: far away, crossed, parted, the entry.
constexpr std::array leaves{0.0, 3.0, 3.8, 6.6};

double least_jerk(double u) {
  const double v = std::clamp(u, 0.0, 1.0);
  return v * v * v * (10 + v * (6 * v - 15));
}

// A thousand times: arms are crossed, part, and the tip goes to an entry and stays there, a little off.
TEST(Menu, WhatIsMeantIsPicked) {
  std::mt19937 random(17);
  std::normal_distribution<double> miss(0, 4);
  std::uniform_real_distribution<double> turn(-0.4, 0.4);
  const auto seed = [&random] { return static_cast<std::uint32_t>(random()); };
  // What happens then, in words.
  const std::map<char, std::string> meant{{'l', "Link"},     {'o', "Lay over"}, {'c', "Cut"},   {'m', "Measure"},
                                          {'f', "Freeze"},   {'p', "Snapshot"}, {'i', "Cards"}, {'x', "Exchange hands"},
                                          {'r', "Recentre"}, {'h', "Words"},    {'q', "Leave"}};
  constexpr int trials = 1000;
  int opened = 0, right_ones = 0, more = 0, left_unasked = 0;
  for (int trial = 0; trial < trials; ++trial) {
    auto entry = meant.begin();
    std::advance(entry, trial % static_cast<int>(meant.size()));
    HandMotion left_hand(seed(), -1);
    Session session(seed());
    const auto lean = [&] { return exp_so3({turn(random), turn(random), turn(random)}); };
    Vec3 place_of_left = left_hand.at(0).translation;
    // Below the eyes.
    place_of_left.y = std::abs(place_of_left.y);
    // Each arm leans over to the other hand's side, the right one in front.
    const Pose left{exp_so3({0, 0, std::numbers::pi / 4}) * exp_so3({0, std::numbers::pi, 0}) * lean(), place_of_left};
    const Quat q = exp_so3({0, 0, -std::numbers::pi / 4}) * lean();
    const Vec3 middle{0, -arm / 2, 0};
    const Vec3 crossed = left * middle - Vec3{0, 0, 8} - rotate(q, middle);
    const Vec3 off{miss(random), miss(random), 0};
    const double deeper = 1 + 0.03 * miss(random);
    // From place to place, one after the other.
    const Vec3 aside = crossed + Vec3{90, 60, 0};
    std::vector<Vec3> way{crossed + Vec3{180, 40, 30}, crossed, aside};
    Done done;
    for (double t = 0; t < 11.5; t = session.seconds()) {
      const Vec3 shake{std::sin(47 * t), std::sin(53 * t + 1), std::sin(61 * t + 2)};
      Vec3 place = way[0];
      for (std::size_t i = 1; i < way.size(); ++i)
        place = place + least_jerk((t - leaves.at(i - 1)) / 0.9) * (way[i] - way[i - 1]);
      const ComparisonView& view = session.show(left, {q, place + 0.7 * shake});
      done.take(view);
      // Once it hangs: the tip before the entry, as the eye at the world's origin sees it.
      if (way.size() == 3 && view.menu.amount > 0)
        for (const char key : {entry->first, menu_entries[CompareMenu::sure_entry].key})
          if (way.size() == 3 || entry->first == 'q')
            way.push_back(deeper * (world_place(view.menu, key) + off) - rotate(q, stick_points[0]));
    }
    opened += !done.words.empty() && done.words[0] == "Menu";
    right_ones += done.words.size() > 1 && done.words[1] == entry->second;
    more += done.words.size() > 2 && done.words[2] != "End";
    left_unasked += entry->first != 'q' && done.asked.find('q') != std::string::npos;
  }
  std::printf("menu: %d of %d opened, %d picked what was meant, %d something else besides\n", opened, trials,
              right_ones, more);
  EXPECT_GE(opened, trials * 99 / 100);
  EXPECT_GE(right_ones, trials * 99 / 100);
  EXPECT_EQ(left_unasked, 0);
}

// Left to hands that move freely and do not mind the menu, which is opened every quarter of a minute or not at all.
TEST(Menu, HardlyAnybodyLeavesByAccident) {
  for (const bool opened : {false, true}) {
    std::map<std::string, int> counts;
    constexpr int sessions = 60, seconds = 600;
    for (int session_number = 0; session_number < sessions; ++session_number) {
      const auto seed = static_cast<std::uint32_t>(4000 + 3 * session_number);
      HandMotion left(seed, -1), right(seed + 1, 1);
      Session session(seed + 2);
      Done done;
      double next = 5;
      for (double t = 0; t < seconds; t = session.seconds()) {
        const ComparisonView& view = session.show(left.at(t), right.at(t));
        done.take(view);
        if (!opened || t < next) continue;
        next = t + 15;
        if (view.menu.amount == 0) session.press('n');
      }
      for (const std::string& word : done.words) ++counts[word];
    }
    std::printf("free motion, %d times 10 minutes, menu %s:\n", sessions, opened ? "opened by key" : "left alone");
    for (const auto& [word, count] : counts) std::printf("  %s %d\n", word.c_str(), count);
    EXPECT_LE(counts["Leave"], opened ? counts["Menu"] / 400 : 0);
    EXPECT_GE(counts["Menu"], opened ? 30 * sessions : 0);
    EXPECT_LE(counts["Menu"], opened ? 40 * sessions : sessions / 2);
  }
}

}  // namespace
}  // namespace onestroke
