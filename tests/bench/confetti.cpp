#include "confetti.h"

#include <opencv2/imgproc.hpp>

#include <random>

namespace onestroke::bench {
namespace {

constexpr int scraps = 600;
// Levels by which a marker differs from what is behind it, and pixels that its blur reaches.
constexpr int difference = 16, rim = 3;

}  // namespace

void scatter_confetti(std::vector<std::uint8_t>& rgb, const std::vector<std::uint8_t>& empty, int width, int height) {
  const cv::Mat3b picture(height, width, reinterpret_cast<cv::Vec3b*>(rgb.data()));
  const cv::Mat bare(height, width, CV_8UC3, const_cast<std::uint8_t*>(empty.data()));
  cv::Mat apart, channels[3], marker;
  cv::absdiff(picture, bare, apart);
  cv::split(apart, channels);
  marker = cv::max(cv::max(channels[0], channels[1]), channels[2]) > difference;
  cv::dilate(marker, marker, cv::Mat::ones(2 * rim + 1, 2 * rim + 1, CV_8U));
  cv::Mat scattered = picture.clone();
  std::mt19937 random(17);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int i = 0; i < scraps; ++i) {
    const cv::RotatedRect scrap(cv::Point2f(static_cast<float>(below(width)), static_cast<float>(below(height))),
                                cv::Size2f(static_cast<float>(width / 200 + below(width / 50)),
                                           static_cast<float>(width / 200 + below(width / 50))),
                                static_cast<float>(below(180)));
    cv::Scalar color(60 + below(60), 60 + below(60), 60 + below(60));
    color[below(3)] += 110;
    cv::Point2f corners[4];
    scrap.points(corners);
    std::vector<cv::Point> outline;
    for (const cv::Point2f& c : corners) outline.emplace_back(cvRound(c.x), cvRound(c.y));
    cv::fillConvexPoly(scattered, outline, color, cv::LINE_AA);
  }
  scattered.copyTo(picture, marker == 0);
}

}  // namespace onestroke::bench
