#include "camera/open_camera.h"
#include "scene_fixture.h"

#include <opencv2/core/persistence.hpp>
#include <opencv2/imgcodecs.hpp>

#include <fstream>

namespace onestroke::test {
namespace {

class Calibration : public testing::Test {
 protected:
  ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "camera.yaml";

  void SetUp() override {
    std::filesystem::create_directory(folder_ / "pictures");
    cv::imwrite((folder_ / "pictures" / "a.png").string(), cv::Mat(24, 32, CV_8UC3, cv::Scalar(1, 2, 3)));
  }
  void write(int width, int height, const cv::Mat& distortion) const {
    cv::FileStorage out(file_.string(), cv::FileStorage::WRITE);
    out << "image_width" << width << "image_height" << height;
    out << "camera_matrix" << (cv::Mat_<double>(3, 3) << 40, 0, 15.5, 0, 41, 11.25, 0, 0, 1);
    out << "distortion_coefficients" << distortion;
  }
  std::unique_ptr<Camera> open() const {
    CameraOptions options;
    options.spec = "folder:" + (folder_ / "pictures").string();
    options.calibration = file_;
    options.fov_rad = 1;
    return open_camera(options);
  }
};

TEST_F(Calibration, OverridesTheFieldOfViewAndMovesThePixelCentres) {
  write(32, 24, (cv::Mat_<double>(1, 5) << 0.1, -0.2, 0.003, 0.004, 0.5));
  const auto camera = open();
  const PictureHandle p = take(*camera);
  EXPECT_DOUBLE_EQ(p->intrinsics.fx, 40);
  EXPECT_DOUBLE_EQ(p->intrinsics.fy, 41);
  EXPECT_DOUBLE_EQ(p->intrinsics.cx, 16);
  EXPECT_DOUBLE_EQ(p->intrinsics.cy, 11.75);
  EXPECT_EQ(p->intrinsics.distortion, (std::array<double, 5>{0.1, -0.2, 0.003, 0.004, 0.5}));
}

TEST_F(Calibration, OfAnotherSizeIsRefused) {
  write(64, 48, cv::Mat::zeros(5, 1, CV_64F));
  const std::string message = error_of([&] { open(); });
  EXPECT_NE(message.find("64 x 48"), std::string::npos) << message;
  EXPECT_NE(message.find("32 x 24"), std::string::npos) << message;
  EXPECT_NE(message.find("camera.yaml"), std::string::npos) << message;
}

TEST_F(Calibration, WithoutSizeMatrixOrSenseIsRefused) {
  EXPECT_NE(error_of([&] { open(); }).find("not there"), std::string::npos);
  std::ofstream(file_) << "%YAML:1.0\n---\ncamera_matrix: 3\n";
  EXPECT_NE(error_of([&] { open(); }).find("image_width"), std::string::npos) << error_of([&] { open(); });
  std::ofstream(file_) << "%YAML:1.0\n---\nimage_width: 32\nimage_height: 24\n";
  EXPECT_NE(error_of([&] { open(); }).find("camera_matrix"), std::string::npos) << error_of([&] { open(); });
  std::ofstream(file_) << "this is: [ no calibration";
  EXPECT_NE(error_of([&] { open(); }).find("camera.yaml"), std::string::npos) << error_of([&] { open(); });
  write(32, 24, cv::Mat::zeros(8, 1, CV_64F));
  EXPECT_NE(error_of([&] { open(); }).find("8 distortion_coefficients"), std::string::npos)
      << error_of([&] { open(); });
}

TEST_F(Calibration, DrawsSyntheticPicturesThroughItsLens) {
  write(640, 480, (cv::Mat_<double>(1, 5) << 0.1, 0, 0, 0, 0));
  const Catalog catalog = two_markers();
  CameraOptions options;
  options.spec = "synthetic:width=640,height=480";
  options.catalog = &catalog;
  options.calibration = file_;
  const auto camera = open_camera(options);
  EXPECT_DOUBLE_EQ(take(*camera)->intrinsics.distortion[0], 0.1);
  options.spec = "synthetic:width=320,height=240";
  EXPECT_NE(error_of([&] { open_camera(options); }).find("640 x 480"), std::string::npos);
}

}  // namespace
}  // namespace onestroke::test
