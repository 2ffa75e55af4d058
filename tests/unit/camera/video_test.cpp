#include "camera/open_camera.h"
#include "scene_fixture.h"

#include <opencv2/videoio.hpp>

#include <fstream>

namespace onestroke::test {
namespace {

constexpr int pictures = 25;

/// A video whose pictures differ in brightness, with detail that makes every one of them weigh something in the file.
void write_video(const std::filesystem::path& file, const char* codec) {
  cv::VideoWriter out(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]),
                      20, cv::Size(160, 120));
  ASSERT_TRUE(out.isOpened());
  cv::Mat grain(120, 160, CV_8UC3);
  for (int i = 0; i < pictures; ++i) {
    cv::randu(grain, 0, 30);
    out.write(grain + cv::Scalar(0, 0, 8 * i));
  }
}

std::unique_ptr<Camera> open(const std::filesystem::path& file) {
  CameraOptions options;
  options.spec = "file:" + file.string();
  options.fov_rad = 1;
  return open_camera(options);
}

TEST(Video, GivesThePicturesAtTheContainersTimes) {
  const ScratchFolder folder;
  write_video(folder / "a.avi", "MJPG");
  const auto camera = open(folder / "a.avi");
  EXPECT_FALSE(camera->live());
  EXPECT_NEAR(camera->rate(), 20, 1e-6);
  EXPECT_EQ(camera->length(), static_cast<std::size_t>(pictures));
  for (int i = 0; i < pictures; ++i) {
    const PictureHandle p = take(*camera);
    EXPECT_EQ(p->sequence, static_cast<std::uint64_t>(i));
    EXPECT_NEAR((p->exposure.start - Time{}).ms(), 50.0 * i, 1e-3);
    EXPECT_NEAR(p->planes[0][0], 8 * i + 15, 30) << "red comes first";
  }
  PictureHandle none;
  EXPECT_EQ(camera->next(none), Camera::Status::end);
  EXPECT_EQ(camera->message(), "");
}

TEST(Video, NamesItsPictures) {
  const ScratchFolder folder;
  write_video(folder / "a.mp4", "mp4v");
  const auto camera = open(folder / "a.mp4");
  const PictureHandle a = take(*camera), b = take(*camera);
  EXPECT_STREQ(a->source, "frame_000000");
  EXPECT_STREQ(b->source, "frame_000001");
}

TEST(Video, CutShortEndsWithAMessageOrDoesNotOpen) {
  const ScratchFolder folder;
  write_video(folder / "a.avi", "MJPG");
  std::filesystem::resize_file(folder / "a.avi", std::filesystem::file_size(folder / "a.avi") / 2);
  const auto camera = open(folder / "a.avi");
  PictureHandle p;
  int seen = 0;
  while (camera->next(p) == Camera::Status::ok) {
    ++seen;
    p.reset();
  }
  EXPECT_GT(seen, 5);
  EXPECT_LT(seen, 20);
  EXPECT_NE(camera->message().find("a.avi"), std::string::npos) << camera->message();
  EXPECT_NE(camera->message().find("cut short"), std::string::npos) << camera->message();

  write_video(folder / "b.mp4", "mp4v");
  std::filesystem::resize_file(folder / "b.mp4", std::filesystem::file_size(folder / "b.mp4") / 2);
  EXPECT_NE(error_of([&] { open(folder / "b.mp4"); }).find("b.mp4"), std::string::npos);
}

TEST(Video, MissingAndForeignFilesAreErrors) {
  const ScratchFolder folder;
  EXPECT_NE(error_of([&] { open(folder / "none.mp4"); }).find("none.mp4"), std::string::npos);
  std::ofstream(folder / "text.mp4") << "no video at all";
  EXPECT_NE(error_of([&] { open(folder / "text.mp4"); }).find("text.mp4"), std::string::npos);
}

}  // namespace
}  // namespace onestroke::test
