#include "camera/rig_file.h"

#include "../core/error_of.h"
#include "scene_fixture.h"

#include <gmock/gmock.h>
#include <opencv2/core/persistence.hpp>

#include <cmath>

namespace onestroke::test {
namespace {

using testing::HasSubstr;

class RigFile : public testing::Test {
 protected:
  static constexpr double turn = 0.02;

  static cv::Mat camera_matrix() { return (cv::Mat_<double>(3, 3) << 500, 0, 319.5, 0, 510, 239.5, 0, 0, 1); }
  static cv::Mat plain() { return (cv::Mat_<double>(1, 5) << 0.1, -0.2, 0.003, 0.004, 0.05); }
  static cv::Mat rotation() {
    return (cv::Mat_<double>(3, 3) << std::cos(turn), 0, std::sin(turn), 0, 1, 0, -std::sin(turn), 0, std::cos(turn));
  }
  static void write_place(cv::FileStorage& out, double scale = 1) {
    out << "R" << rotation() << "T" << (cv::Mat_<double>(3, 1) << -62 * scale, 1 * scale, 2 * scale);
  }
  static void write_lenses(cv::FileStorage& out, const cv::Mat& second = plain()) {
    out << "M1" << camera_matrix() << "D1" << plain() << "M2" << camera_matrix() << "D2" << second;
  }
  std::filesystem::path file(const char* name = "rig.yml") const { return folder_ / name; }
  cv::FileStorage storage(const char* name = "rig.yml") const { return {file(name).string(), cv::FileStorage::WRITE}; }
  std::string refusal() const {
    return error_of([this] { read_rig(file()); });
  }

  ScratchFolder folder_;
};

TEST_F(RigFile, SaysWhereTheSecondCameraSitsAndBothLenses) {
  {
    cv::FileStorage out = storage();
    write_place(out);
    write_lenses(out);
  }
  const Rig rig = read_rig(file());
  // x2 = R x1 + T.
  const Vec3 point{30, -40, 500}, seen = inverse(rig.T_first_second) * point;
  EXPECT_NEAR(seen.x, std::cos(turn) * 30 + std::sin(turn) * 500 - 62, 1e-9);
  EXPECT_NEAR(seen.y, -39, 1e-9);
  EXPECT_NEAR(seen.z, -std::sin(turn) * 30 + std::cos(turn) * 500 + 2, 1e-9);
  ASSERT_TRUE(rig.lenses);
  const Intrinsics k = (*rig.lenses)[1].intrinsics(640, 480, "a picture");
  EXPECT_DOUBLE_EQ(k.fy, 510);
  EXPECT_DOUBLE_EQ(k.cx, 320) << "pixel centres at half-integers";
  EXPECT_EQ(k.distortion, (std::array<double, 5>{0.1, -0.2, 0.003, 0.004, 0.05}));
  EXPECT_THAT(error_of([&] { (*rig.lenses)[0].intrinsics(1280, 960, "a picture"); }), HasSubstr("of another size"));
}

TEST_F(RigFile, TakesTheNamesOfTheFunctionToo) {
  {
    cv::FileStorage out = storage();
    write_place(out);
    out << "image_width" << 640 << "image_height" << 480;
    for (const char* n : {"1", "2"})
      out << std::string("cameraMatrix") + n << camera_matrix() << std::string("distCoeffs") + n << plain();
  }
  const Rig rig = read_rig(file());
  ASSERT_TRUE(rig.lenses);
  EXPECT_DOUBLE_EQ((*rig.lenses)[0].intrinsics(640, 480, "a picture").fx, 500);
  EXPECT_THAT(error_of([&] { (*rig.lenses)[0].intrinsics(640, 400, "a picture"); }), HasSubstr("640 x 480"));
}

TEST_F(RigFile, TakesTheTwoFilesOfOpenCVsSample) {
  {
    cv::FileStorage out = storage("extrinsics.yml");
    write_place(out);
  }
  EXPECT_FALSE(read_rig(file("extrinsics.yml")).lenses) << "--fov may say";
  {
    cv::FileStorage out = storage("intrinsics.yml");
    write_lenses(out);
  }
  const Rig rig = read_rig(file("extrinsics.yml"));
  ASSERT_TRUE(rig.lenses);
  EXPECT_DOUBLE_EQ((*rig.lenses)[0].intrinsics(640, 480, "a picture").fx, 500);
}

// The sample calibrates with CALIB_RATIONAL_MODEL.
TEST_F(RigFile, TakesARationalLensByThePolynomialNearestToIt) {
  const cv::Mat rational = (cv::Mat_<double>(1, 14) << -0.3, 0.1, 0.001, 0.002, 0, 0, 0, 0.02, 0, 0, 0, 0, 0, 0);
  {
    cv::FileStorage out = storage();
    write_place(out);
    write_lenses(out, rational);
  }
  const Intrinsics k = (*read_rig(file()).lenses)[1].intrinsics(640, 480, "a picture");
  EXPECT_EQ(k.distortion[2], 0.001);
  EXPECT_EQ(k.distortion[3], 0.002);
  for (double r = 0; r < 0.79; r += 0.05) {
    const double r2 = r * r, wanted = (1 - 0.3 * r2 + 0.1 * r2 * r2) / (1 + 0.02 * r2 * r2 * r2);
    const double got = 1 + r2 * (k.distortion[0] + r2 * (k.distortion[1] + r2 * k.distortion[4]));
    EXPECT_LT(std::abs(wanted - got) * r * 500, 0.25) << r;
  }
}

TEST_F(RigFile, IsRefusedWithTheReason) {
  EXPECT_THAT(refusal(), HasSubstr("is not there; give what cv::stereoCalibrate found"));
  {
    cv::FileStorage out = storage();
    out << "R" << rotation();
  }
  EXPECT_THAT(refusal(), HasSubstr("has no rotation R and translation T"));
  {
    cv::FileStorage out = storage();
    out << "R" << 2 * rotation() << "T" << (cv::Mat_<double>(3, 1) << 60, 0, 0);
  }
  EXPECT_THAT(refusal(), HasSubstr("R is no rotation"));
  {
    cv::FileStorage out = storage();
    write_place(out, 1e-3);
  }
  EXPECT_THAT(refusal(), HasSubstr("T must be in millimetres"));
  {
    cv::FileStorage out = storage();
    write_place(out);
    out << "M1" << camera_matrix() << "D1" << plain();
  }
  EXPECT_THAT(refusal(), HasSubstr("has no lens M2 and D2"));
  const cv::Mat prism = (cv::Mat_<double>(1, 12) << 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0);
  {
    cv::FileStorage out = storage();
    write_place(out);
    write_lenses(out, prism);
  }
  EXPECT_THAT(refusal(), HasSubstr("D2 has coefficients of a thin prism"));
  const cv::Mat steep = (cv::Mat_<double>(1, 8) << 0, 0, 0, 0, 0, -1.5, 0, 0);
  {
    cv::FileStorage out = storage();
    write_place(out);
    write_lenses(out, steep);
  }
  EXPECT_THAT(refusal(), HasSubstr("calibrate without CALIB_RATIONAL_MODEL"));
}

TEST(ParallelRig, IsBeside) {
  EXPECT_EQ(parallel_rig(64).T_first_second.translation, (Vec3{64, 0, 0}));
  EXPECT_FALSE(parallel_rig(64).lenses);
}

}  // namespace
}  // namespace onestroke::test
