// Sampling all channels at once against sampling one after another.

#include "tracking/sampling.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace onestroke::test {
namespace {

Color to_color(const ColorLanes& lanes) {
  float c[4];
  cv::v_store(c, lanes);
  return {c[0], c[1], c[2]};
}

TEST(Sampling, LanesGiveWhatSingleChannelsGive) {
  constexpr int width = 23, height = 17;
  constexpr std::size_t stride = 3 * width;
  std::mt19937 random(4);
  // On the heap and without room to spare, so that a read beyond the last pixel shows under a sanitizer.
  std::vector<std::uint8_t> bytes(stride * height);
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() % 256);
  const ImageView image{bytes.data(), width, height, stride};
  std::uniform_real_distribution<double> u(0.5, width - 0.5), v(0.5, height - 0.5);
  for (int i = 0; i < 5000; ++i) {
    // Every tenth lies in the last corner.
    const double x = i % 10 ? u(random) : width - 0.5 - 1e-3 * (i % 7 + 1), y = i % 10 ? v(random) : height - 0.501;
    ASSERT_TRUE(image.contains(x, y));
    const Color lanes = to_color(sample_lanes(image, x, y)), single = image.sample(x, y);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(lanes[c], single[c], 2 * 255 / 4096.0) << x << ' ' << y;
  }
}

TEST(Sampling, IsExactAtPixelCentresAndBetweenThem) {
  const std::vector<std::uint8_t> bytes{10, 20, 30, 50, 60, 70, 110, 120, 130, 150, 160, 170};
  const ImageView image{bytes.data(), 2, 2, 6};
  const Color first = image.sample(0.5, 0.5), middle = image.sample(1, 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(first[c], 10 * static_cast<float>(c + 1));
    EXPECT_EQ(middle[c], 80 + 10 * static_cast<float>(c));
  }
}

}  // namespace
}  // namespace onestroke::test
