#include "scene/compare_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

namespace onestroke {
namespace {

constexpr std::array links{Link::apart, Link::same, Link::mirrored};
constexpr std::array tools{Tool::none, Tool::overlay, Tool::fitted, Tool::section, Tool::measure};
constexpr std::array signs{Sign::starts_together, Sign::ends_together, Sign::corners_together, Sign::corners_parted,
                           Sign::start_on_corner, Sign::start_on_end,  Sign::end_on_corner,    Sign::arms_crossed,
                           Sign::twisted,         Sign::untwisted,     Sign::stick_gone};

CompareMode made(CompareMode mode, Sign sign) {
  const ModeRule* rule = find_rule(mode, sign);
  return rule ? after(mode, *rule) : mode;
}

// Every mode and every sign: what is not named leaves all as it is.
TEST(CompareModes, ChangeAsTheTableSaysAndNotOtherwise) {
  for (const Link link : links) {
    const CompareMode plain{link, Tool::none};
    const Link next = link == Link::apart ? Link::same : link == Link::same ? Link::mirrored : Link::apart;
    using Step = std::tuple<Tool, Sign>;
    const std::map<Step, CompareMode> steps{{{Tool::none, Sign::starts_together}, {next, Tool::none}},
                                            {{Tool::none, Sign::corners_together}, {link, Tool::overlay}},
                                            {{Tool::none, Sign::start_on_corner}, {link, Tool::section}},
                                            {{Tool::none, Sign::start_on_end}, {link, Tool::measure}},
                                            {{Tool::overlay, Sign::twisted}, {link, Tool::fitted}},
                                            {{Tool::overlay, Sign::corners_parted}, plain},
                                            {{Tool::overlay, Sign::stick_gone}, plain},
                                            {{Tool::fitted, Sign::untwisted}, {link, Tool::overlay}},
                                            {{Tool::fitted, Sign::corners_parted}, plain},
                                            {{Tool::fitted, Sign::stick_gone}, plain},
                                            {{Tool::section, Sign::start_on_corner}, plain},
                                            {{Tool::section, Sign::stick_gone}, plain},
                                            {{Tool::measure, Sign::start_on_end}, plain},
                                            {{Tool::measure, Sign::stick_gone}, plain}};
    for (const Tool tool : tools)
      for (const Sign sign : signs) {
        const CompareMode used{link, tool};
        const auto step = steps.find({tool, sign});
        EXPECT_EQ(made(used, sign), step == steps.end() ? used : step->second)
            << name_of(link) << ", " << name_of(tool) << ", " << name_of(sign);
      }
  }
}

TEST(CompareModes, ActInEveryMode) {
  for (const Link link : links)
    for (const Tool tool : tools)
      for (const Sign sign : signs) {
        const ModeRule* rule = find_rule({link, tool}, sign);
        const Act act = rule ? rule->act : Act::none;
        EXPECT_EQ(act, sign == Sign::end_on_corner   ? Act::freeze
                       : sign == Sign::ends_together ? Act::snapshot
                       : sign == Sign::arms_crossed  ? Act::menu
                                                     : Act::none);
      }
}

TEST(CompareModes, HaveAKeyForEverySignThatHandsMake) {
  for (const Link link : links)
    for (const Tool tool : tools)
      for (const Sign sign : signs) {
        if (!find_rule({link, tool}, sign) || sign == Sign::stick_gone) continue;
        const auto key = std::ranges::find(sign_keys, sign, &SignKey::sign);
        ASSERT_NE(key, sign_keys.end()) << name_of(sign);
        EXPECT_EQ(sign_of(key->key, {link, tool}), sign);
      }
  EXPECT_EQ(sign_of('b', {Link::apart, Tool::none}), std::nullopt);
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
      const bool tools_meet = !a.tool || !b.tool || *a.tool == *b.tool;
      const bool both = tools_meet && a.sign == b.sign && (!a.link || !b.link || *a.link == *b.link);
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
  EXPECT_EQ(sign_of({StickPoint::corner, StickPoint::end}), Sign::end_on_corner);
  EXPECT_EQ(sign_of({StickPoint::end, StickPoint::end}), Sign::ends_together);
  EXPECT_EQ(sign_of({StickPoint::arm, StickPoint::arm}), Sign::arms_crossed);
}

TEST(CompareModes, AreWrittenOutALineARule) {
  const std::string table = mode_table();
  EXPECT_EQ(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')), mode_rules.size() + 2);
  EXPECT_NE(table.find("| side by side | start tips together | L | linked | Link |"), std::string::npos) << table;
  EXPECT_NE(table.find("| overlay | corners parted | O | what was before |  |"), std::string::npos);
  EXPECT_NE(table.find("| any | end tips together | P | a snapshot is saved | Snapshot |"), std::string::npos);
}

TEST(CompareModes, StandInTheManualAsTheyAre) {
  std::ifstream file(ONESTROKE_SOURCE_DIR "/README.md");
  const std::string manual((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(manual.find("\n" + mode_table() + "\n"), std::string::npos);
  EXPECT_NE(manual.find("```mermaid\n" + mode_diagram() + "```\n"), std::string::npos);
  EXPECT_NE(manual.find("\n" + menu_table() + "\n"), std::string::npos);
}

TEST(CompareModes, AreDrawnAnArrowARule) {
  const std::string text = mode_diagram();
  int arrows = 0;
  for (std::size_t at = text.find("-->"); at != std::string::npos; at = text.find("-->", at + 1)) ++arrows;
  // Two lead to where it begins; what acts leads nowhere.
  EXPECT_EQ(static_cast<std::size_t>(arrows), mode_rules.size() + 2 - 3);
  EXPECT_NE(text.find("overlay --> best_fit: one stick twisted"), std::string::npos) << text;
}

}  // namespace
}  // namespace onestroke
