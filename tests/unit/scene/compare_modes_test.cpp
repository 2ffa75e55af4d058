#include "scene/compare_modes.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace onestroke {
namespace {

constexpr std::array links{Link::apart, Link::same, Link::mirrored};
constexpr std::array tools{Tool::none, Tool::overlay, Tool::section, Tool::measure};
constexpr std::array signs{Sign::starts_together, Sign::corners_together, Sign::corners_parted,
                           Sign::start_on_corner, Sign::start_on_end,     Sign::stick_gone};

CompareMode made(CompareMode mode, Sign sign) {
  const ModeRule* rule = find_rule(mode, sign);
  return rule ? after(mode, *rule) : mode;
}

// Every mode and every sign: what is not named leaves all as it is.
TEST(CompareModes, ChangeAsTheTableSaysAndNotOtherwise) {
  for (const Link link : links) {
    const CompareMode plain{link, Tool::none};
    const Link next = link == Link::apart ? Link::same : link == Link::same ? Link::mirrored : Link::apart;
    EXPECT_EQ(made(plain, Sign::starts_together), (CompareMode{next, Tool::none}));
    EXPECT_EQ(made(plain, Sign::corners_together), (CompareMode{link, Tool::overlay}));
    EXPECT_EQ(made(plain, Sign::start_on_corner), (CompareMode{link, Tool::section}));
    EXPECT_EQ(made(plain, Sign::start_on_end), (CompareMode{link, Tool::measure}));
    EXPECT_EQ(made(plain, Sign::corners_parted), plain);
    EXPECT_EQ(made(plain, Sign::stick_gone), plain);
    using Leave = std::tuple<Tool, Sign>;
    const std::set<Leave> leaves{{Tool::overlay, Sign::corners_parted},  {Tool::overlay, Sign::stick_gone},
                                 {Tool::section, Sign::start_on_corner}, {Tool::section, Sign::stick_gone},
                                 {Tool::measure, Sign::start_on_end},    {Tool::measure, Sign::stick_gone}};
    for (const Tool tool : {Tool::overlay, Tool::section, Tool::measure})
      for (const Sign sign : signs) {
        const CompareMode used{link, tool};
        EXPECT_EQ(made(used, sign), (leaves.contains({tool, sign}) ? plain : used))
            << name_of(link) << ", " << name_of(tool) << ", " << name_of(sign);
      }
  }
}

TEST(CompareModes, AreUndoneByTheirOpposites) {
  for (const Link link : links) {
    const CompareMode plain{link, Tool::none};
    EXPECT_EQ(made(made(plain, Sign::corners_together), Sign::corners_parted), plain);
    for (const Sign sign : {Sign::start_on_corner, Sign::start_on_end}) EXPECT_EQ(made(made(plain, sign), sign), plain);
    CompareMode round = plain;
    for (int i = 0; i < 3; ++i) round = made(round, Sign::starts_together);
    EXPECT_EQ(round, plain);
  }
}

TEST(CompareModes, HaveOneRuleForEachSign) {
  for (std::size_t i = 0; i < mode_rules.size(); ++i)
    for (std::size_t k = i + 1; k < mode_rules.size(); ++k) {
      const ModeRule &a = mode_rules[i], &b = mode_rules[k];
      const bool both = a.tool == b.tool && a.sign == b.sign && (!a.link || !b.link || *a.link == *b.link);
      EXPECT_FALSE(both) << i << " " << k;
    }
}

TEST(CompareModes, CanAllBeReached) {
  std::set<std::tuple<Link, Tool>> reached{{Link::apart, Tool::none}};
  for (int step = 0; step < 4; ++step)
    for (const auto& [link, tool] : std::set(reached))
      for (const Sign sign : signs) {
        const CompareMode next = made({link, tool}, sign);
        reached.insert({next.link, next.tool});
      }
  EXPECT_EQ(reached.size(), links.size() * tools.size());
}

TEST(CompareModes, TakeATouchForTheSameFromEitherHand) {
  EXPECT_EQ(sign_of({StickPoint::start, StickPoint::corner}), Sign::start_on_corner);
  EXPECT_EQ(sign_of({StickPoint::corner, StickPoint::start}), Sign::start_on_corner);
  EXPECT_EQ(sign_of({StickPoint::end, StickPoint::start}), Sign::start_on_end);
  EXPECT_EQ(sign_of({StickPoint::end, StickPoint::end}), std::nullopt);
}

TEST(CompareModes, AreWrittenOutALineARule) {
  const std::string table = mode_table();
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), mode_rules.size() + 2);
  EXPECT_NE(table.find("| side by side | start tips together | linked | Link |"), std::string::npos);
  EXPECT_NE(table.find("| overlay | corners parted | what was before |  |"), std::string::npos);
}

}  // namespace
}  // namespace onestroke
