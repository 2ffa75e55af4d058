// Pictures without a marker: nothing may be reported.

#include "photographs.h"
#include "synthetic_set.h"
#include "tracking/tracker.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <iostream>
#include <map>
#include <sstream>

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
      EXPECT_EQ(record_.marker_count, 0) << what << ": marker " << record_.markers[0].id
                                         << (tracker == &live_ ? ", live" : ", alone");
    }
  }

 private:
  // Both search thoroughly in every picture, the second quickly before.
  Tracker alone_{synthetic_catalog(), {.independent = true}};
  Tracker live_{synthetic_catalog(), {.miss_thoroughly_every = 1}};
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

// Photographs that Debian's packages bring, parted so that tests may share the processor's cores.
class PhotographReports : public FalseReports, public ::testing::WithParamInterface<std::size_t> {};
constexpr std::size_t shares = 12;

TEST_P(PhotographReports, NothingIsReported) {
  const std::vector<Photograph> all = photographs();
  for (std::size_t i = GetParam(); i < all.size(); i += shares) {
    const cv::Mat3b picture = cv::imread(all[i].file, cv::IMREAD_COLOR);
    for (const cv::Rect& view : views_of(picture.size())) {
      std::ostringstream name;
      name << all[i].package << ": " << all[i].file << ' ' << view;
      expect_nothing(read_view(picture, view), name.str());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Share, PhotographReports, ::testing::Range<std::size_t>(0, shares));

TEST(Photographs, AreAtLeast500) {
  struct Count {
    int photographs = 0, parts = 0;
  };
  std::map<std::string, Count> by_package;
  Count sum;
  for (const Photograph& p : photographs()) {
    const auto parts = static_cast<int>(views_of(cv::imread(p.file, cv::IMREAD_COLOR).size()).size()) - 1;
    if (parts < 0) continue;
    for (Count* c : {&by_package[p.package], &sum}) {
      ++c->photographs;
      c->parts += parts;
    }
  }
  const auto say = [](const std::string& what, const Count& c) {
    std::cout << what << ": " << c.photographs << " photographs, and " << c.parts << " parts of large ones\n";
  };
  for (const auto& [package, count] : by_package) say(package, count);
  say("all", sum);
  EXPECT_GE(sum.photographs, 500);
}

}  // namespace
}  // namespace onestroke::accuracy
