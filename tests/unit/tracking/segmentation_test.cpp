#include "tracking/segmentation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace onestroke::test {
namespace {

using Rgb = std::array<double, 3>;

// Printed inks under a white light that the camera is balanced for, as coded values.
constexpr std::array<Rgb, 3> inks{{{190, 45, 40}, {45, 150, 60}, {40, 65, 170}}};

struct Patch {
  int width, height;
  std::size_t stride;
  std::vector<std::uint8_t> bytes;

  Patch(Rgb color, int w, int h, std::size_t padding = 0)
      : width(w),
        height(h),
        stride(3 * static_cast<std::size_t>(w) + padding),
        bytes(stride * static_cast<std::size_t>(h), 255) {
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          bytes[static_cast<std::size_t>(y) * stride + 3 * static_cast<std::size_t>(x) + c] =
              static_cast<std::uint8_t>(std::clamp(color[c] + 0.5, 0.0, 255.0));
  }
  ImageView view() const { return {bytes.data(), width, height, stride}; }
};

/// The one label of a flat patch.
int label_of(const Rgb& color, const SegmentationOptions& options = {}) {
  const Patch patch(color, 5, 3);
  std::vector<std::uint8_t> labels;
  segment(patch.view(), options, labels);
  EXPECT_EQ(labels.size(), 15u);
  const std::set<int> all(labels.begin(), labels.end());
  EXPECT_EQ(all.size(), 1u);
  return *all.begin();
}

Rgb scaled(const Rgb& color, const Rgb& by) {
  return {color[0] * by[0], color[1] * by[1], color[2] * by[2]};
}

TEST(Segmentation, InksKeepTheirLabelFromFullLightToDeepShade) {
  for (int ink = 0; ink < 3; ++ink)
    for (const double light : {1.3, 1.0, 0.6, 0.3, 0.12})
      EXPECT_EQ(label_of(scaled(inks[static_cast<std::size_t>(ink)], {light, light, light})), ink) << "light " << light;
}

TEST(Segmentation, AFactorLooksAtTheMiddleOfEachSquare) {
  Patch patch({0, 0, 0}, 14, 9, 5);
  std::mt19937 random(3);
  for (std::uint8_t& b : patch.bytes) b = static_cast<std::uint8_t>(random() % 256);
  std::vector<std::uint8_t> all, some;
  segment(patch.view(), {}, all);
  segment(patch.view(), {}, some, 4);
  ASSERT_EQ(some.size(), 3u * 2u);
  for (std::size_t y = 0; y < 2; ++y)
    for (std::size_t x = 0; x < 3; ++x) EXPECT_EQ(some[3 * y + x], all[14 * (4 * y + 2) + 4 * x + 2]);
}

// Rows of fewer than sixteen pixels are labelled pixel by pixel, longer ones in lanes.
TEST(Segmentation, LanesGiveWhatSinglePixelsGive) {
  std::mt19937 random(9);
  Patch patch({0, 0, 0}, 16 * 7 + 5, 40, 3);
  for (std::uint8_t& b : patch.bytes) b = static_cast<std::uint8_t>(random() % 256);
  // Colours near grey, where margins decide.
  for (std::size_t i = patch.bytes.size() / 2; i < patch.bytes.size(); ++i)
    patch.bytes[i] = static_cast<std::uint8_t>(random() % 200 / 8 + random() % 24);
  for (const float relative : {0.0F, 0.12F, 0.3F, 1.0F})
    for (const float absolute : {0.0F, 6.5F, 7.0F, 255.0F}) {
      const SegmentationOptions options{.relative_margin = relative, .absolute_margin = absolute};
      std::vector<std::uint8_t> lanes, single;
      segment(patch.view(), options, lanes);
      for (int y = 0; y < patch.height; ++y)
        for (int x = 0; x < patch.width; ++x) {
          segment({patch.view().at(x, y), 1, 1, patch.stride}, options, single);
          ASSERT_EQ(lanes[static_cast<std::size_t>(y * patch.width + x)], single.front()) << x << ' ' << y;
        }
    }
}

TEST(Segmentation, PaintIsToldFromPetalsByTheLeastOfItsChannels) {
  const SegmentationOptions options{.least_share = 0.12F};
  for (int ink = 0; ink < 3; ++ink) EXPECT_EQ(label_of(inks[static_cast<std::size_t>(ink)], options), ink);
  const Rgb petal{160, 30, 3}, screen{10, 20, 220};
  EXPECT_EQ(label_of(petal), 0);
  EXPECT_EQ(label_of(petal, options), no_ink);
  EXPECT_EQ(label_of(screen), 2);
  EXPECT_EQ(label_of(screen, options), no_ink);
}

TEST(Segmentation, PeelingPartsWhatASeamJoins) {
  constexpr int width = 13, height = 7;
  std::vector<std::uint8_t> labels(std::size_t{width} * height, no_ink);
  const auto at = [&](int x, int y) -> std::uint8_t& { return labels[static_cast<std::size_t>(y * width + x)]; };
  // Two squares of red joined by a row of it, from border to border of the picture.
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < 5; ++x) at(x, y) = at(8 + x, y) = 0;
  for (int x = 5; x < 8; ++x) at(x, 3) = 0;
  peel(width, height, labels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      // Where the seam set out there is red on all sides.
      const bool set_out = y == 3 && (x == 4 || x == 8);
      const bool inner = y > 0 && y < height - 1 && ((x > 0 && x < 4) || (x > 8 && x < 12));
      EXPECT_EQ(at(x, y), inner || set_out ? 0 : no_ink) << x << ' ' << y;
    }
}

TEST(Segmentation, InksKeepTheirLabelUnderMildColourCasts) {
  for (int ink = 0; ink < 3; ++ink)
    for (const Rgb& cast : {Rgb{1.15, 1, 0.8}, Rgb{0.85, 1, 1.15}, Rgb{1, 1.1, 1}})
      EXPECT_EQ(label_of(scaled(inks[static_cast<std::size_t>(ink)], cast)), ink);
}

TEST(Segmentation, BlueGainReadsLamplight) {
  constexpr Rgb lamplight{1.25, 0.95, 0.42};
  const Rgb blue = scaled({70, 75, 170}, lamplight);
  EXPECT_NE(label_of(blue), 2);
  SegmentationOptions warm;
  warm.blue_gain = 1.6F;
  EXPECT_EQ(label_of(blue, warm), 2);
  EXPECT_EQ(label_of(scaled(inks[0], lamplight), warm), 0);
  EXPECT_EQ(label_of(scaled(inks[1], lamplight), warm), 1);
}

// As leaves and walls throw it back: green ink has nearly as much red in it.
TEST(Segmentation, RedGainReadsLightOfAWarmTint) {
  const Rgb green{98, 104, 49}, blue{100, 73, 78}, red{158, 53, 45};
  EXPECT_NE(label_of(green), 1);
  SegmentationOptions tinted;
  tinted.blue_gain = 1.6F;
  tinted.red_gain = 0.75F;
  EXPECT_EQ(label_of(green, tinted), 1);
  EXPECT_EQ(label_of(blue, tinted), 2);
  EXPECT_EQ(label_of(red, tinted), 0);
}

TEST(Segmentation, GreysAndMixturesAreNoInk) {
  for (double level = 0; level <= 255; level += 5) EXPECT_EQ(label_of({level, level, level}), no_ink);
  EXPECT_EQ(label_of({200, 195, 60}), no_ink) << "yellow";
  EXPECT_EQ(label_of({60, 200, 195}), no_ink) << "cyan";
  EXPECT_EQ(label_of({195, 60, 200}), no_ink) << "magenta";
  EXPECT_EQ(label_of({9, 3, 3}), no_ink) << "black, but for its noise";
}

TEST(Segmentation, MarginsDecide) {
  SegmentationOptions options;
  options.relative_margin = 0.4F;
  options.absolute_margin = 20;
  EXPECT_EQ(label_of({100, 59, 20}, options), 0);
  EXPECT_EQ(label_of({100, 62, 20}, options), no_ink) << "less than the relative margin";
  EXPECT_EQ(label_of({30, 12, 12}, options), no_ink) << "less than the absolute margin";
  EXPECT_EQ(label_of({33, 12, 12}, options), 0);
}

TEST(Segmentation, RowPaddingIsNoPicture) {
  const Patch patch(inks[2], 7, 4, 11);
  std::vector<std::uint8_t> labels(3, 99);
  segment(patch.view(), {}, labels);
  ASSERT_EQ(labels.size(), 28u);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 2), 28);
}

TEST(Segmentation, LabelsStandWhereTheirPixelsAre) {
  Patch patch({128, 128, 128}, 6, 5);
  const std::size_t at = 3 * patch.stride + 3 * 4;
  patch.bytes[at] = 220;
  std::vector<std::uint8_t> labels;
  segment(patch.view(), {}, labels);
  for (std::size_t i = 0; i < labels.size(); ++i) EXPECT_EQ(labels[i], i == 3 * 6 + 4 ? 0 : no_ink) << i;
}

TEST(Smoothing, KeepsFlatColoursAndQuietsNoise) {
  Patch patch({120, 80, 40}, 64, 64, 5);
  std::vector<std::uint8_t> out;
  smooth(patch.view(), 2, out);
  ASSERT_EQ(out.size(), 3u * 64 * 64);
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_EQ(out[i], i % 3 == 0 ? 120 : i % 3 == 1 ? 80 : 40);

  std::mt19937 random(7);
  std::normal_distribution<double> noise(128, 12);
  for (std::uint8_t& b : patch.bytes) b = static_cast<std::uint8_t>(noise(random));
  smooth(patch.view(), 2, out);
  double sum = 0, square = 0;
  for (const std::uint8_t b : out) sum += b, square += b * b;
  const double n = static_cast<double>(out.size()), mean = sum / n;
  EXPECT_NEAR(mean, 127.5, 1);
  // A Gaussian of sigma s leaves 1 / (4 pi s^2) of the variance: 2 % here, and rounding's twelfth.
  EXPECT_LT(square / n - mean * mean, 0.04 * 144);
}

}  // namespace
}  // namespace onestroke::test
