// Pictures without a marker: nothing may be reported.

#include "synthetic_set.h"
#include "tracking/tracker.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <iostream>

namespace onestroke::accuracy {
namespace {

constexpr double pi = 3.14159265358979;

class FalseReports : public ::testing::Test {
 protected:
  void expect_nothing(const cv::Mat3b& rgb, const std::string& what) {
    Picture picture;
    picture.width = rgb.cols;
    picture.height = rgb.rows;
    picture.planes[0] = rgb.data;
    picture.strides[0] = rgb.step;
    picture.intrinsics = Intrinsics::from_fov(rgb.cols, rgb.rows, 35 * pi / 180);
    for (Tracker* tracker : {&alone_, &live_}) {
      tracker->process(picture, record_);
      EXPECT_EQ(record_.marker_count, 0) << what << ": marker " << record_.markers[0].id;
    }
  }

 private:
  // Searches each picture thoroughly, and looks quickly first.
  Tracker alone_{synthetic_catalog(), {.independent = true}}, live_{synthetic_catalog()};
  FrameRecord record_;
};

cv::Scalar vivid(cv::RNG& random) {
  cv::Scalar color(random.uniform(10, 80), random.uniform(10, 80), random.uniform(10, 80));
  color[random.uniform(0, 3)] = random.uniform(120, 250);
  return color;
}

// Rows of small coloured pieces are what a marker is made of; these have no catalogued code.
TEST_F(FalseReports, ColouredStripesAndBricks) {
  cv::RNG random(3);
  for (int i = 0; i < 4; ++i) {
    cv::Mat3b picture(240, 320, cv::Vec3b(120, 120, 120));
    const int length = 8 + 4 * i, depth = 14 + 5 * i;
    for (int y = 0; y + depth < picture.rows; y += depth + 6)
      for (int x = 0; x + length < picture.cols; x += length)
        if (random.uniform(0, 10) < 8) cv::rectangle(picture, cv::Rect(x, y, length, depth), vivid(random), cv::FILLED);
    cv::GaussianBlur(picture, picture, cv::Size(), 0.7);
    expect_nothing(picture, "bricks " + std::to_string(i));
  }
}

TEST_F(FalseReports, Confetti) {
  cv::RNG random(4);
  for (int i = 0; i < 3; ++i) {
    cv::Mat3b picture(600, 800, cv::Vec3b(90, 100, 110));
    for (int k = 0; k < 900; ++k) {
      const cv::RotatedRect piece(cv::Point2f(random.uniform(0.F, 800.F), random.uniform(0.F, 600.F)),
                                  cv::Size2f(random.uniform(4.F, 12.F), random.uniform(10.F, 24.F)),
                                  random.uniform(0.F, 180.F));
      cv::Point2f corners[4];
      piece.points(corners);
      std::vector<cv::Point> polygon(corners, corners + 4);
      cv::fillConvexPoly(picture, polygon, vivid(random), cv::LINE_AA);
    }
    expect_nothing(picture, "confetti " + std::to_string(i));
  }
}

// Cloudy colour at every scale, as gardens and rugs have it.
TEST_F(FalseReports, ColouredClouds) {
  cv::RNG random(5);
  for (int i = 0; i < 4; ++i) {
    cv::Mat3f sum(600, 800, cv::Vec3f(110, 110, 110));
    for (int cell = 4; cell <= 128; cell *= 2) {
      cv::Mat3f coarse(600 / cell + 2, 800 / cell + 2), fine;
      random.fill(coarse, cv::RNG::NORMAL, 0, 12 + 10 * i);
      cv::resize(coarse, fine, sum.size(), 0, 0, cv::INTER_CUBIC);
      sum += fine;
    }
    cv::Mat3b picture;
    sum.convertTo(picture, CV_8UC3);
    expect_nothing(picture, "clouds " + std::to_string(i));
  }
}

// Debian's wallpapers, where some are installed: photographs and drawings.
TEST_F(FalseReports, Wallpapers) {
  int looked_at = 0;
  for (const char* root : {"/usr/share/backgrounds", "/usr/share/wallpapers"}) {
    if (!std::filesystem::is_directory(root)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".jpg" && kind != ".png" && kind != ".jpeg") continue;
      cv::Mat3b picture = cv::imread(entry.path().string(), cv::IMREAD_COLOR);
      if (picture.empty()) continue;
      const double scale = 1280.0 / picture.cols;
      cv::resize(picture, picture, cv::Size(), scale, scale, cv::INTER_AREA);
      cv::cvtColor(picture, picture, cv::COLOR_BGR2RGB);
      expect_nothing(picture, entry.path().string());
      ++looked_at;
    }
  }
  std::cout << looked_at << " wallpapers looked at\n";
}

}  // namespace
}  // namespace onestroke::accuracy
