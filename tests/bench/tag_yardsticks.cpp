#include "yardsticks.h"

#include <opencv2/aruco.hpp>

namespace onestroke::bench {
namespace {

class Aruco : public Yardstick {
 public:
  explicit Aruco(bool aruco3) {
    parameters_->useAruco3Detection = aruco3;
    // Tags are looked for in a picture made as small as tags of this share of it allow: the point of ArUco 3.
    if (aruco3) parameters_->minMarkerLengthRatioOriginalImg = 0.05F;
  }

  int tags(const BenchPictures& pictures) override {
    const cv::Mat gray(pictures.height(), pictures.width(), CV_8UC1, const_cast<std::uint8_t*>(pictures.gray().data()));
    cv::aruco::detectMarkers(gray, dictionary_, corners_, ids_, parameters_);
    return static_cast<int>(ids_.size());
  }

 private:
  cv::Ptr<cv::aruco::Dictionary> dictionary_ = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  cv::Ptr<cv::aruco::DetectorParameters> parameters_ = cv::aruco::DetectorParameters::create();
  std::vector<std::vector<cv::Point2f>> corners_;
  std::vector<int> ids_;
};

}  // namespace

std::unique_ptr<Yardstick> aruco_yardstick(bool aruco3) {
  return std::make_unique<Aruco>(aruco3);
}

}  // namespace onestroke::bench
