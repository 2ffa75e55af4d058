#include "scene/color_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace onestroke {
namespace {

using Rgb = std::array<float, 3>;

float luminance(const Rgb& c) {
  return 0.2126F * c[0] + 0.7152F * c[1] + 0.0722F * c[2];
}

/// As people without red or green cones see it: Machado, Oliveira and Fernandes 2009, severity 1, linear light.
Rgb seen(const std::array<std::array<float, 3>, 3>& m, const Rgb& c) {
  Rgb result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i] += m[i][j] * c[j];
  return result;
}
constexpr std::array<std::array<float, 3>, 3> protanope{
    {{0.152286F, 1.052583F, -0.204868F}, {0.114503F, 0.786281F, 0.099216F}, {-0.003882F, -0.048116F, 1.051998F}}};
constexpr std::array<std::array<float, 3>, 3> deuteranope{
    {{0.367322F, 0.860646F, -0.227968F}, {0.280085F, 0.672501F, 0.047413F}, {-0.011820F, 0.042940F, 0.968881F}}};

/// Blue against the mean of red and green, of all light: what is left to them of hue.
float blueness(const Rgb& c) {
  return (c[2] - (c[0] + c[1]) / 2) / (c[0] + c[1] + c[2]);
}

TEST(ColorScale, GetsDarkerAwayFromNone) {
  const ColorScale scale(2);
  EXPECT_GT(luminance(scale.color(0)), 0.9F);
  for (double d = 0; d < 2; d += 0.05)
    for (const double side : {-1.0, 1.0})
      EXPECT_GT(luminance(scale.color(side * d)), luminance(scale.color(side * (d + 0.05)))) << side * d;
}

TEST(ColorScale, StaysAsItIsBeyondItsEnds) {
  const ColorScale scale(2);
  EXPECT_EQ(scale.color(2), scale.color(5));
  EXPECT_EQ(scale.color(-2), scale.color(-1e9));
}

TEST(ColorScale, TellsTheSidesApartWithoutRedOrGreenCones) {
  const ColorScale scale(1);
  for (double d = 0.2; d <= 1; d += 0.1)
    for (const auto& eyes : {protanope, deuteranope}) {
      EXPECT_GT(blueness(seen(eyes, scale.color(-d))), 0.02F) << d;
      EXPECT_LT(blueness(seen(eyes, scale.color(d))), -0.05F) << d;
    }
}

TEST(ColorScale, EndsAtARoundNumber) {
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(0.37, 0.01).reach(), 0.5);
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(0.5, 0.01).reach(), 0.5);
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(0.51, 0.01).reach(), 1);
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(12, 0.01).reach(), 20);
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(7, 0.01).reach(), 10);
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(0.002, 0.01).reach(), 0.01);
  EXPECT_DOUBLE_EQ(ColorScale::for_distances(0, 0.01).reach(), 0.01);
}

}  // namespace
}  // namespace onestroke
