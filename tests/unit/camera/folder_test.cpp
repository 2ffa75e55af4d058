#include "camera/open_camera.h"
#include "camera/picture_file.h"
#include "scene_fixture.h"

#include <opencv2/imgcodecs.hpp>

#include <fstream>

namespace onestroke::test {
namespace {

/// A picture of one colour, red, green, blue.
void write_picture(const std::filesystem::path& file, int width, int height, int r, int g, int b) {
  ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(height, width, CV_8UC3, cv::Scalar(b, g, r))));
}

/// A picture with much detail, so that cutting the file cuts the picture.
void write_busy_picture(const std::filesystem::path& file) {
  cv::Mat m(240, 320, CV_8UC3);
  cv::randu(m, 0, 255);
  ASSERT_TRUE(cv::imwrite(file.string(), m));
}

void cut(const std::filesystem::path& file, double share) {
  const auto size = std::filesystem::file_size(file);
  std::filesystem::resize_file(file, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
}

class Folder : public testing::Test {
 protected:
  ScratchFolder folder_;

  std::unique_ptr<Camera> open() {
    CameraOptions options;
    options.spec = "folder:" + folder_.path().string();
    options.fov_rad = 35 * radian;
    options.readout = Duration::from_ms(9);
    return open_camera(options);
  }
};

TEST_F(Folder, GivesPicturesInTheOrderOfTheirNames) {
  write_picture(folder_ / "v_10.png", 32, 24, 10, 0, 0);
  write_picture(folder_ / "v_9.png", 32, 24, 9, 200, 50);
  write_picture(folder_ / "v_2.JPG", 32, 24, 2, 0, 0);
  std::ofstream(folder_ / "notes.txt") << "no picture";
  const auto camera = open();
  EXPECT_EQ(camera->length(), 3u);
  EXPECT_FALSE(camera->live());
  const PictureHandle a = take(*camera), b = take(*camera), c = take(*camera);
  EXPECT_STREQ(a->source, "v_2.JPG");
  EXPECT_STREQ(b->source, "v_9.png");
  EXPECT_STREQ(c->source, "v_10.png");
  EXPECT_EQ(b->format, PixelFormat::rgb8);
  EXPECT_EQ(b->planes[0][0], 9);
  EXPECT_EQ(b->planes[0][1], 200);
  EXPECT_EQ(b->planes[0][2], 50);
  EXPECT_EQ(c->sequence, 2u);
  EXPECT_EQ(c->exposure.start.ns, 66'666'667);
  EXPECT_EQ(c->exposure.length.ns, 0);
  EXPECT_EQ(c->exposure.readout.ns, 9'000'000);
  EXPECT_NEAR(c->intrinsics.fx, 16 / std::tan(17.5 * radian), 1e-9);
  EXPECT_DOUBLE_EQ(c->intrinsics.cy, 12);
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::end);
  EXPECT_EQ(camera->message(), "");
}

TEST_F(Folder, ACutJpegEndsItAndIsNamed) {
  for (const double share : {0.95, 0.5, 0.02}) {
    write_busy_picture(folder_ / "a.jpg");
    write_busy_picture(folder_ / "b.jpg");
    cut(folder_ / "b.jpg", share);
    const auto camera = open();
    take(*camera).reset();
    PictureHandle p;
    EXPECT_EQ(camera->next(p), Camera::Status::end) << share;
    EXPECT_NE(camera->message().find("b.jpg"), std::string::npos) << camera->message();
    EXPECT_EQ(camera->next(p), Camera::Status::end) << "and stays at its end";
  }
}

TEST_F(Folder, ACutPngEndsItAndIsNamed) {
  for (const double share : {0.99, 0.5, 0.0}) {
    write_busy_picture(folder_ / "a.png");
    write_busy_picture(folder_ / "b.png");
    cut(folder_ / "b.png", share);
    const auto camera = open();
    take(*camera).reset();
    PictureHandle p;
    EXPECT_EQ(camera->next(p), Camera::Status::end) << share;
    EXPECT_NE(camera->message().find("b.png"), std::string::npos) << camera->message();
  }
}

TEST_F(Folder, ABrokenFirstPictureAndAChangedSizeAreNamed) {
  std::ofstream(folder_ / "a.png") << "this is no picture";
  PictureHandle p;
  {
    const auto camera = open();
    EXPECT_EQ(camera->next(p), Camera::Status::end);
    EXPECT_NE(camera->message().find("a.png"), std::string::npos) << camera->message();
  }
  write_picture(folder_ / "a.png", 32, 24, 1, 1, 1);
  write_picture(folder_ / "b.png", 40, 24, 1, 1, 1);
  const auto camera = open();
  take(*camera).reset();
  EXPECT_EQ(camera->next(p), Camera::Status::end);
  EXPECT_NE(camera->message().find("b.png"), std::string::npos) << camera->message();
  EXPECT_NE(camera->message().find("40 x 24"), std::string::npos) << camera->message();
}

TEST_F(Folder, MissingAndEmptyFoldersAndAnUnknownLensAreErrors) {
  EXPECT_NE(error_of([&] { open(); }).find("holds no"), std::string::npos);
  CameraOptions options;
  options.spec = "folder:" + (folder_ / "nowhere").string();
  options.fov_rad = 1;
  EXPECT_NE(error_of([&] { open_camera(options); }).find("nowhere"), std::string::npos);
  options.fov_rad.reset();
  const std::string lens = error_of([&] { open_camera(options); });
  EXPECT_NE(lens.find("give --fov DEG or --calibration FILE.yaml"), std::string::npos) << lens;
}

TEST_F(Folder, BuffersComeBackWhenHandlesGo) {
  for (int i = 0; i < 12; ++i) write_picture(folder_ / (std::to_string(i) + ".png"), 16, 16, i, 0, 0);
  const auto camera = open();
  std::vector<PictureHandle> held;
  PictureHandle p;
  while (camera->next(p) == Camera::Status::ok) held.push_back(std::move(p));
  EXPECT_LT(held.size(), 12u);
  EXPECT_EQ(camera->next(p), Camera::Status::busy);
  std::size_t seen = held.size();
  held.clear();
  while (camera->next(p) == Camera::Status::ok) {
    EXPECT_EQ(p->planes[0][0], seen);
    ++seen;
    p.reset();
  }
  EXPECT_EQ(seen, 12u);
}

TEST(NaturalOrder, CountsDigitsByTheirValue) {
  EXPECT_TRUE(natural_less("a9", "a10"));
  EXPECT_FALSE(natural_less("a10", "a9"));
  EXPECT_TRUE(natural_less("a09", "a10"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_TRUE(natural_less("a1b2", "a1b11"));
  EXPECT_NE(natural_less("a01", "a1"), natural_less("a1", "a01"));
  EXPECT_FALSE(natural_less("a1", "a1"));
}

}  // namespace
}  // namespace onestroke::test
