// Blurring by a disc's rows against blurring by its pixels.

#include "tracking/disc_blur.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace onestroke::test {
namespace {

using Pixel4 = cv::Vec4f;

cv::Mat noise(int rows, int cols) {
  cv::Mat picture(rows, cols, CV_32FC4);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(0, 1);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < cols; ++x)
      picture.at<Pixel4>(y, x) = Pixel4(value(random), value(random), value(random), value(random));
  return picture;
}

/// The mean over a disc whose rim is smooth over a pixel, the picture's edges repeated.
Pixel4 mean_over_disc(const cv::Mat& from, double radius, int y, int x) {
  const int reach = static_cast<int>(std::ceil(radius));
  Pixel4 sum(0, 0, 0, 0);
  float total = 0;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto share = static_cast<float>(std::clamp(radius + 0.5 - std::hypot(dx, dy), 0.0, 1.0));
      sum += share * from.at<Pixel4>(std::clamp(y + dy, 0, from.rows - 1), std::clamp(x + dx, 0, from.cols - 1));
      total += share;
    }
  return sum * (1 / total);
}

class DiscBlurs : public ::testing::TestWithParam<double> {};

TEST_P(DiscBlurs, AreTheMeansOverADisc) {
  const double sigma = GetParam();
  const cv::Mat from = noise(31, 45);
  const std::vector<PixelRun> where{{0, 0, 45}, {3, 10, 12}, {17, 0, 3}, {17, 40, 45}, {30, 20, 45}};
  DiscBlur disc;
  cv::Mat to;
  disc.blur(from, sigma, where, to);
  ASSERT_EQ(to.size(), from.size());
  for (const PixelRun& run : where)
    for (int x = run.x0; x < run.x1; ++x) {
      const Pixel4 expected = mean_over_disc(from, 2 * sigma, run.y, x);
      for (int c = 0; c < 4; ++c) ASSERT_NEAR(to.at<Pixel4>(run.y, x)[c], expected[c], 2e-5) << run.y << ' ' << x;
    }
}

TEST_P(DiscBlurs, AreNothingElsewhere) {
  DiscBlur disc;
  cv::Mat to;
  disc.blur(noise(20, 20), GetParam(), std::vector<PixelRun>{{5, 5, 9}}, to);
  EXPECT_EQ(to.at<Pixel4>(5, 4), Pixel4(0, 0, 0, 0));
  EXPECT_EQ(to.at<Pixel4>(5, 9), Pixel4(0, 0, 0, 0));
  EXPECT_EQ(to.at<Pixel4>(6, 6), Pixel4(0, 0, 0, 0));
  EXPECT_GT(to.at<Pixel4>(5, 5)[0], 0);
}

// Below half a pixel's radius, up to wider than the picture is high.
INSTANTIATE_TEST_SUITE_P(Sigmas, DiscBlurs, ::testing::Values(0.2, 0.5, 0.9, 1.3, 2.7, 5.5, 9.0, 17.0));

TEST(DiscBlur, KeepsNothingFromThePictureBefore) {
  DiscBlur disc;
  cv::Mat wide, again, first;
  const std::vector<PixelRun> where{{4, 2, 10}};
  const cv::Mat picture = noise(12, 16);
  DiscBlur().blur(picture, 1.7, where, first);
  disc.blur(noise(40, 40), 6, std::vector<PixelRun>{{20, 0, 40}}, wide);
  disc.blur(picture, 1.7, where, again);
  EXPECT_EQ(cv::norm(first, again, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace onestroke::test
