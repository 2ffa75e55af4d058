#include "tracking/inks.h"

#include "tracking/ink_matcher.h"

#include <gtest/gtest.h>

#include <random>

namespace onestroke::test {
namespace {

constexpr std::array<std::array<float, 3>, 3> colors{{{180, 50, 45}, {50, 150, 70}, {45, 70, 170}}};

Color color(int ink, float light = 1) {
  const auto& c = colors[static_cast<std::size_t>(ink)];
  return light * Color(c[0], c[1], c[2]);
}

Inks learnt(std::initializer_list<int> which = {0, 1, 2}) {
  InkSamples samples;
  for (const int ink : which) samples.add(ink, color(ink));
  return samples.mean();
}

TEST(Inks, MatchFollowsTheChromaticityNotTheLight) {
  const Inks inks = learnt();
  for (const float light : {0.2F, 0.5F, 1.0F, 1.4F})
    for (int seen = 0; seen < 3; ++seen)
      for (int expected = 0; expected < 3; ++expected)
        EXPECT_EQ(inks.match(color(seen, light), expected),
                  seen == expected ? Inks::Match::agrees : Inks::Match::contradicts);
}

TEST(Inks, GreySkinAndTheDarkSayNothing) {
  const Inks inks = learnt();
  for (int expected = 0; expected < 3; ++expected) {
    EXPECT_EQ(inks.match({130, 130, 130}, expected), Inks::Match::unknown) << "grey";
    EXPECT_EQ(inks.match({4, 2, 2}, expected), Inks::Match::unknown) << "too dark to tell";
    EXPECT_EQ(inks.match({200, 150, 120}, expected), Inks::Match::unknown) << "skin";
  }
}

TEST(Inks, AVeiledCellStillAgrees) {
  const Inks inks = learnt();
  for (int ink = 0; ink < 3; ++ink) EXPECT_EQ(inks.match(0.75F * color(ink) + 20, ink), Inks::Match::agrees);
}

TEST(Inks, SeparationIsTheNearestPair) {
  EXPECT_EQ(learnt({1}).separation, 0);
  const Inks two = learnt({0, 2}), three = learnt();
  const auto distance = [](int a, int b) { return (chromaticity(color(a)) - chromaticity(color(b))).matrix().norm(); };
  EXPECT_NEAR(two.separation, distance(0, 2), 1e-5);
  EXPECT_NEAR(three.separation, std::min({distance(0, 1), distance(0, 2), distance(1, 2)}), 1e-5);
}

TEST(Inks, WhatIsNotKnownCannotAgree) {
  const Inks inks = learnt({0, 2});
  EXPECT_FALSE(inks.known[1]);
  EXPECT_EQ(inks.match(color(0), 0), Inks::Match::agrees);
  EXPECT_EQ(inks.match(color(2), 0), Inks::Match::contradicts);
  EXPECT_NE(inks.match(color(1), 1), Inks::Match::agrees);
  EXPECT_EQ(Inks{}.match(color(0), 0), Inks::Match::unknown);
}

TEST(Inks, SamplesAreAveragedByChromaticity) {
  InkSamples samples;
  samples.add(0, Color(100, 50, 50));
  samples.add(0, Color(20, 5, 15));
  samples.add(1, Color(10, 100, 10));
  const Inks inks = samples.mean();
  EXPECT_NEAR(inks.chroma[0][0], 0.5F, 1e-4F);
  EXPECT_NEAR(inks.chroma[0][1], (0.25F + 0.125F) / 2, 1e-4F);
  EXPECT_NEAR(inks.chroma[0].sum(), 1, 1e-4F);
}

// A colour on the border of an ink may fall on either side of it.
bool on_border(const Inks& inks, const Color& c, int expected) {
  for (int channel = 0; channel < 3; ++channel)
    for (const float step : {-0.01F, 0.01F}) {
      Color beside = c;
      beside[channel] += step;
      if (inks.match(beside, expected) != inks.match(c, expected)) return true;
    }
  return false;
}

TEST(InkMatcher, SaysWhatInksSay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> level(0, 255);
  std::array<int, 3> said{};
  for (const Inks& inks : {learnt(), learnt({0, 2}), learnt({1}), Inks{}}) {
    const InkMatcher matcher(inks);
    for (int i = 0; i < 6000; ++i) {
      const Color c = i % 50 == 0 ? Color(level(random) / 40, level(random) / 40, 0)
                                  : Color(level(random), level(random), level(random));
      const int expected = i % 3;
      const Inks::Match match = matcher.match(to_lanes(c), expected);
      ++said[static_cast<std::size_t>(match)];
      ASSERT_TRUE(match == inks.match(c, expected) || on_border(inks, c, expected))
          << c.transpose() << ", expected " << expected;
    }
  }
  for (const int count : said) EXPECT_GT(count, 300);
}

}  // namespace
}  // namespace onestroke::test
