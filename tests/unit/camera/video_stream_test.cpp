// Videos of every kind: times, colours, turns, and places in them.

#include "camera/open_camera.h"
#include "scene_fixture.h"
#include "video_fixture.h"

#include <gmock/gmock.h>

#include <cstring>
#include <numeric>

namespace onestroke::test {
namespace {

using testing::HasSubstr;

std::unique_ptr<Camera> open(const std::filesystem::path& file, const Playback& playback = {},
                             std::optional<Duration> readout = {}) {
  CameraOptions options;
  options.spec = "file:" + file.string();
  options.fov_rad = 1;
  options.playback = playback;
  options.readout = readout;
  return open_camera(options);
}

/// Which picture it is, by its level.
int number_of(const Picture& p) {
  const double level = p.planes[0][3 * (p.width / 2) + static_cast<int>(p.strides[0]) * (p.height / 2)];
  return static_cast<int>(std::lround(((level - 0) * 219 / 255 + 16 - 30) / 4));
}

/// Between 5 and 100 ms apart, as a telephone's are.
std::vector<std::int64_t> uneven(std::size_t count) {
  std::vector<std::int64_t> times;
  std::int64_t at = 0;
  for (std::size_t i = 0; i < count; ++i, at += 5 + static_cast<std::int64_t>(i * i * 37 % 96)) times.push_back(at);
  return times;
}

class VideoKinds : public testing::Test {
 protected:
  ScratchFolder folder_;
};

TEST_F(VideoKinds, EveryPictureHasItsOwnTime) {
  const std::vector<std::int64_t> times = uneven(40);
  for (const char* name : {"a.mkv", "b.mp4", "c.mov", "d.nut"})
    for (const int between : {0, 2}) {
      write_video(folder_ / name, {.between = between}, times);
      const auto camera = open(folder_ / name);
      for (std::size_t i = 0; i < times.size(); ++i) {
        const PictureHandle p = take(*camera);
        ASSERT_TRUE(p) << name << " " << i << " " << between;
        EXPECT_EQ(p->exposure.start.ns, times[i] * 1'000'000) << name << " " << i;
        EXPECT_EQ(number_of(*p), static_cast<int>(i)) << name;
        EXPECT_EQ(p->sequence, i);
      }
      PictureHandle none;
      EXPECT_EQ(camera->next(none), Camera::Status::end);
      EXPECT_EQ(camera->message(), "") << name << ": pictures at all times are no sign of damage";
    }
}

TEST_F(VideoKinds, TimesAreKeptToTheNanosecond) {
  std::vector<std::int64_t> times(30);
  std::iota(times.begin(), times.end(), 7);
  write_video(folder_ / "a.mp4", {.time_base = {1001, 30000}}, times);
  const auto camera = open(folder_ / "a.mp4");
  EXPECT_NEAR(camera->rate(), 30000.0 / 1001, 1e-9);
  EXPECT_EQ(camera->length(), 30u);
  for (std::int64_t i = 0; i < 30; ++i)
    EXPECT_EQ(take(*camera)->exposure.start.ns, (i * 1001 * 1'000'000'000 + 15000) / 30000) << i;
}

TEST_F(VideoKinds, AreEnteredAnywhere) {
  const std::vector<std::int64_t> times = uneven(60);
  for (const char* codec : {"mpeg4", "libx264", "mjpeg"})
    for (const char* name : {"a.mkv", "b.mp4", "c.nut"}) {
      VideoKind kind{.codec = codec, .between = std::string(codec) == "mjpeg" ? 0 : 2};
      if (std::string(codec) == "mjpeg") kind.pixels = AV_PIX_FMT_YUVJ420P;
      write_video(folder_ / name, kind, times);
      const auto camera = open(folder_ / name);
      for (const std::size_t wanted : {41u, 40u, 3u, 0u, 59u, 12u, 13u, 25u, 24u}) {
        // Between the picture before and this one.
        const std::int64_t at = wanted == 0 ? -5 : (times[wanted - 1] + times[wanted] + 1) / 2;
        EXPECT_TRUE(camera->seek(Duration::from_ms(static_cast<double>(at))));
        for (std::size_t i = wanted; i < std::min<std::size_t>(wanted + 3, times.size()); ++i) {
          const PictureHandle p = take(*camera);
          ASSERT_TRUE(p);
          EXPECT_EQ(p->sequence, i) << codec << " " << name;
          EXPECT_EQ(p->exposure.start.ns, times[i] * 1'000'000) << codec << " " << name;
          if (kind.pixels == AV_PIX_FMT_YUV420P) {
            EXPECT_EQ(number_of(*p), static_cast<int>(i) % 48) << codec << " " << name;
          }
        }
      }
      camera->seek(Duration::from_seconds(100));
      PictureHandle none;
      EXPECT_EQ(camera->next(none), Camera::Status::end);
      EXPECT_EQ(camera->message(), "");
      camera->seek({});
      EXPECT_EQ(take(*camera)->sequence, 0u) << "from its end, too";
    }
}

TEST_F(VideoKinds, BeginWhereTheyAreToldAndAgain) {
  std::vector<std::int64_t> times(25);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 40 * static_cast<std::int64_t>(i);
  write_video(folder_ / "a.mkv", {.lasts = 40}, times);
  const auto camera = open(folder_ / "a.mkv", {.loop = true, .from = Duration::from_ms(800)});
  EXPECT_EQ(camera->length(), 0u);
  EXPECT_NEAR(camera->period(), 1, 1e-6);
  for (std::size_t i = 20; i < 80; ++i) {
    const PictureHandle p = take(*camera);
    EXPECT_EQ(p->sequence, i);
    EXPECT_EQ((p->exposure.start - Time{}).ns, static_cast<std::int64_t>(i) * 40'000'000);
    EXPECT_EQ(number_of(*p), static_cast<int>(i % 25));
  }
  EXPECT_EQ(open(folder_ / "a.mkv", {.loop = false, .from = Duration::from_ms(800)})->length(), 5u);
  EXPECT_THAT(error_of([&] { open(folder_ / "a.mkv", {.loop = false, .from = Duration::from_seconds(2)}); }),
              HasSubstr("has no picture 2 seconds after its first"));
}

/// An even picture of one colour, in the video's own terms.
std::array<int, 3> color_of(const std::filesystem::path& file) {
  const auto camera = open(file);
  const PictureHandle p = take(*camera);
  EXPECT_EQ(p->format, PixelFormat::rgb8);
  const std::uint8_t* at = p->planes[0] + 3 * (p->width / 2) + static_cast<int>(p->strides[0]) * (p->height / 2);
  return {at[0], at[1], at[2]};
}

template <int Y, int U, int V>
void paint_even(AVFrame& frame, int) {
  constexpr std::array levels{Y, U, V};
  for (int p = 0; p < 3; ++p)
    for (int y = 0; y < (p == 0 ? frame.height : frame.height / 2); ++y)
      std::fill_n(frame.data[p] + y * frame.linesize[p], frame.linesize[p],
                  static_cast<std::uint8_t>(levels[static_cast<std::size_t>(p)]));
}

TEST_F(VideoKinds, ColoursAreTheVideosOwn) {
  const auto expect_near = [](std::array<int, 3> is, std::array<double, 3> is_to_be, const char* what) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(is[c], is_to_be[c], 1.01) << what << " " << c;
  };
  const std::vector<std::int64_t> times{0, 40};
  const auto write = [&](AVColorRange range, AVColorSpace matrix) {
    write_video(folder_ / "a.mkv", {.codec = "ffvhuff", .range = range, .matrix = matrix}, times,
                paint_even<120, 90, 180>);
    return color_of(folder_ / "a.mkv");
  };
  const double y = 120, u = 90 - 128, v = 180 - 128, limited = 255.0 / 219 * (y - 16), chroma = 255.0 / 224;
  expect_near(
      write(AVCOL_RANGE_UNSPECIFIED, AVCOL_SPC_UNSPECIFIED),
      {limited + chroma * 1.402 * v, limited + chroma * (-0.344136 * u - 0.714136 * v), limited + chroma * 1.772 * u},
      "BT.601, unless it says otherwise");
  expect_near(
      write(AVCOL_RANGE_MPEG, AVCOL_SPC_BT709),
      {limited + chroma * 1.5748 * v, limited + chroma * (-0.187324 * u - 0.468124 * v), limited + chroma * 1.8556 * u},
      "BT.709");
  expect_near(write(AVCOL_RANGE_JPEG, AVCOL_SPC_SMPTE170M),
              {y + 1.402 * v, y + -0.344136 * u - 0.714136 * v, y + 1.772 * u}, "full range");
}

void paint_noise(AVFrame& frame, int number) {
  std::uint32_t state = static_cast<std::uint32_t>(number) + 1;
  for (int p = 0; p < 2 && frame.data[p]; ++p)
    for (int i = 0; i < frame.linesize[p] * (p == 0 ? frame.height : frame.height / 2); ++i)
      frame.data[p][i] = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
}

TEST_F(VideoKinds, PlanesThatFitAreHandedOnAsTheyAre) {
  struct Case {
    AVPixelFormat pixels;
    PixelFormat format;
  };
  for (const auto& [pixels, format] :
       {Case{AV_PIX_FMT_NV12, PixelFormat::nv12}, Case{AV_PIX_FMT_YUYV422, PixelFormat::yuyv},
        Case{AV_PIX_FMT_RGB24, PixelFormat::rgb8}, Case{AV_PIX_FMT_GRAY8, PixelFormat::gray8}}) {
    write_video(folder_ / "a.nut", {.codec = "rawvideo", .pixels = pixels}, std::vector<std::int64_t>{0, 40},
                paint_noise);
    const auto camera = open(folder_ / "a.nut");
    const PictureHandle p = take(*camera);
    ASSERT_EQ(p->format, format);
    const HeldAv<AVFrame> frame(av_frame_alloc());
    frame->format = pixels;
    frame->width = 64;
    frame->height = 48;
    ASSERT_GE(av_frame_get_buffer(frame.get(), 0), 0);
    paint_noise(*frame, 0);
    for (int plane = 0; plane < 2 && frame->data[plane]; ++plane)
      for (int y = 0; y < (plane == 0 ? 48 : 24); ++y)
        EXPECT_EQ(
            std::memcmp(p->planes[static_cast<std::size_t>(plane)] +
                            static_cast<std::size_t>(y) * p->strides[static_cast<std::size_t>(plane)],
                        frame->data[plane] + y * frame->linesize[plane], p->strides[static_cast<std::size_t>(plane)]),
            0);
  }
  write_video(folder_ / "b.mkv", {.codec = "rawvideo", .pixels = AV_PIX_FMT_NV12, .matrix = AVCOL_SPC_BT709},
              std::vector<std::int64_t>{0, 40}, paint_noise);
  const auto other = open(folder_ / "b.mkv");
  EXPECT_EQ(take(*other)->format, PixelFormat::rgb8) << "whoever takes nv12 takes it for BT.601";
}

/// The upper left quarter is bright.
void paint_corner(AVFrame& frame, int) {
  paint_even<40, 128, 128>(frame, 0);
  for (int y = 0; y < frame.height / 2; ++y) std::fill_n(frame.data[0] + y * frame.linesize[0], frame.width / 2, 220);
}

TEST_F(VideoKinds, StandUpright) {
  struct Case {
    double turned;
    int width, height;
    double x, y;  // where the bright quarter is then
  };
  for (const auto& [turned, width, height, x, y] : {Case{0, 64, 48, 0.25, 0.25}, Case{90, 48, 64, 0.75, 0.25},
                                                    Case{180, 64, 48, 0.75, 0.75}, Case{-90, 48, 64, 0.25, 0.75}}) {
    write_video(folder_ / "a.mp4", {.turned = turned}, std::vector<std::int64_t>{0, 40}, paint_corner);
    const auto camera = open(folder_ / "a.mp4");
    const PictureHandle p = take(*camera);
    ASSERT_EQ(p->width, width) << turned;
    ASSERT_EQ(p->height, height);
    EXPECT_EQ(p->intrinsics.cx, width / 2.0);
    for (const double u : {0.25, 0.75})
      for (const double v : {0.25, 0.75}) {
        const int level = p->planes[0][static_cast<std::size_t>(v * height) * p->strides[0] +
                                       3 * static_cast<std::size_t>(u * width)];
        EXPECT_EQ(level > 128, u == x && v == y) << turned << " at " << u << ", " << v;
      }
    if (turned != 0) {
      EXPECT_THAT(error_of([&] { open(folder_ / "a.mp4", {}, Duration::from_ms(20)); }),
                  HasSubstr("its rows are not the sensor's; leave out --readout-ms"));
    }
  }
  write_video(folder_ / "a.mp4", {.turned = 30}, std::vector<std::int64_t>{0, 40}, paint_corner);
  EXPECT_THAT(error_of([&] { open(folder_ / "a.mp4"); }), HasSubstr("less than a right angle"));
}

}  // namespace
}  // namespace onestroke::test
