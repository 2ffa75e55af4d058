// Pictures of every format and size, and pictures in which there is nothing to find.

#include "scene_fixture.h"
#include "tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace onestroke::test {
namespace {

struct Yuv {
  double y, u, v;
};

/// BT.601, limited range.
Yuv to_yuv(double r, double g, double b) {
  return {16 + 0.25679 * r + 0.50413 * g + 0.09791 * b, 128 - 0.14822 * r - 0.29099 * g + 0.43922 * b,
          128 + 0.43922 * r - 0.36779 * g - 0.07143 * b};
}

std::uint8_t byte(double v) {
  return static_cast<std::uint8_t>(std::clamp(v + 0.5, 0.0, 255.0));
}

/// Mean of w x h pixels from (x, y).
Yuv mean_yuv(const SyntheticImage& image, int x, int y, int w, int h) {
  double sum[3] = {};
  for (int dy = 0; dy < h; ++dy)
    for (int dx = 0; dx < w; ++dx)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += image.rgb[3 * static_cast<std::size_t>((y + dy) * image.width + x + dx) + c];
  const double n = w * h;
  return to_yuv(sum[0] / n, sum[1] / n, sum[2] / n);
}

/// The planes of a picture in another format, rows padded as cameras pad them.
struct Converted {
  std::vector<std::uint8_t> planes[2];
  std::size_t strides[2] = {};

  Picture over(Picture picture, PixelFormat format) const {
    picture.format = format;
    for (std::size_t i = 0; i < 2; ++i) {
      picture.planes[i] = planes[i].empty() ? nullptr : planes[i].data();
      picture.strides[i] = strides[i];
    }
    return picture;
  }
};

Converted to_nv12(const SyntheticImage& image) {
  Converted c;
  c.strides[0] = c.strides[1] = static_cast<std::size_t>(image.width) + 32;
  c.planes[0].resize(c.strides[0] * static_cast<std::size_t>(image.height));
  c.planes[1].resize(c.strides[1] * static_cast<std::size_t>(image.height / 2));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      c.planes[0][static_cast<std::size_t>(y) * c.strides[0] + static_cast<std::size_t>(x)] =
          byte(mean_yuv(image, x, y, 1, 1).y);
  for (int y = 0; y < image.height; y += 2)
    for (int x = 0; x < image.width; x += 2) {
      const Yuv m = mean_yuv(image, x, y, 2, 2);
      std::uint8_t* at =
          c.planes[1].data() + static_cast<std::size_t>(y / 2) * c.strides[1] + static_cast<std::size_t>(x);
      at[0] = byte(m.u);
      at[1] = byte(m.v);
    }
  return c;
}

Converted to_yuyv(const SyntheticImage& image) {
  Converted c;
  c.strides[0] = 2 * static_cast<std::size_t>(image.width) + 64;
  c.planes[0].resize(c.strides[0] * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; x += 2) {
      const Yuv m = mean_yuv(image, x, y, 2, 1);
      std::uint8_t* at =
          c.planes[0].data() + static_cast<std::size_t>(y) * c.strides[0] + 2 * static_cast<std::size_t>(x);
      at[0] = byte(mean_yuv(image, x, y, 1, 1).y);
      at[1] = byte(m.u);
      at[2] = byte(mean_yuv(image, x + 1, y, 1, 1).y);
      at[3] = byte(m.v);
    }
  return c;
}

Converted to_gray(const SyntheticImage& image) {
  Converted c;
  c.strides[0] = static_cast<std::size_t>(image.width);
  c.planes[0].resize(c.strides[0] * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      c.planes[0][static_cast<std::size_t>(y) * c.strides[0] + static_cast<std::size_t>(x)] =
          byte(mean_yuv(image, x, y, 1, 1).y);
  return c;
}

class TrackerPictures : public ::testing::Test {
 protected:
  const Catalog catalog = catalog_of(4);
  const Pose pose = about_middle(exp_so3({0.5, -0.3, 0.4}), {5, 5, 320});
  const Shot shot = shoot(catalog.markers[2], pose);
  Tracker tracker{catalog, {.independent = true}};

  void expect_pose(const Picture& picture, double degrees, double share) {
    const FrameRecord record = process(tracker, picture);
    ASSERT_EQ(record.marker_count, 1);
    EXPECT_EQ(record.markers[0].id, 3);
    EXPECT_LT(turn_between(record.markers[0].T_camera_marker, pose), degrees);
    EXPECT_LT(shift_between(record.markers[0].T_camera_marker, pose), share);
  }
};

TEST_F(TrackerPictures, EveryColourFormatGivesThePose) {
  expect_pose(shot.picture(), 0.5, 1e-3);
  expect_pose(to_nv12(shot.image).over(shot.picture(), PixelFormat::nv12), 1.2, 3e-3);
  expect_pose(to_yuyv(shot.image).over(shot.picture(), PixelFormat::yuyv), 1.2, 3e-3);
}

TEST_F(TrackerPictures, PaddedRowsGiveThePose) {
  const std::size_t stride = shot.stride() + 96;
  std::vector<std::uint8_t> padded(stride * 480, 200);
  for (std::size_t y = 0; y < 480; ++y)
    std::copy_n(shot.image.rgb.data() + y * shot.stride(), shot.stride(), padded.data() + y * stride);
  Picture picture = shot.picture();
  picture.planes[0] = padded.data();
  picture.strides[0] = stride;
  const FrameRecord plain = process(tracker, shot.picture()), wide = process(tracker, picture);
  ASSERT_EQ(wide.marker_count, 1);
  EXPECT_EQ(plain.markers[0].T_camera_marker.translation, wide.markers[0].T_camera_marker.translation);
}

TEST_F(TrackerPictures, InGreyNoInkCanBeTold) {
  const Converted gray = to_gray(shot.image);
  EXPECT_EQ(process(tracker, gray.over(shot.picture(), PixelFormat::gray8)).marker_count, 0);
}

TEST_F(TrackerPictures, SizesMayChangeFromPictureToPicture) {
  const std::vector<std::uint8_t> small(3 * 64 * 48, 90);
  Picture picture = shot.picture();
  picture.width = 64;
  picture.height = 48;
  picture.planes[0] = small.data();
  picture.strides[0] = 3 * 64;
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(process(tracker, picture).marker_count, 0);
    expect_pose(shot.picture(), 0.5, 1e-3);
  }
}

TEST_F(TrackerPictures, OneInkAllOverIsNoMarker) {
  std::vector<std::uint8_t> red(shot.image.rgb.size(), 30);
  for (std::size_t i = 0; i < red.size(); i += 3) red[i] = 220;
  Picture picture = shot.picture();
  picture.planes[0] = red.data();
  EXPECT_EQ(process(tracker, picture).marker_count, 0);
}

struct Size {
  int width, height;
};

TEST(TrackerTiny, PicturesOfAFewPixelsHoldNothing) {
  const Catalog catalog = catalog_of(4);
  std::mt19937 random(4);
  for (const bool independent : {true, false}) {
    Tracker tracker(catalog, {.independent = independent});
    for (const Size size : {Size{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3, 2}, {8, 8}, {31, 5}}) {
      std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * size.width * size.height));
      for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
      Picture picture;
      picture.width = size.width;
      picture.height = size.height;
      picture.planes[0] = bytes.data();
      picture.strides[0] = static_cast<std::size_t>(3 * size.width);
      picture.intrinsics = Intrinsics::from_fov(size.width, size.height, 1);
      EXPECT_EQ(process(tracker, picture).marker_count, 0) << size.width << " x " << size.height;
    }
  }
}

/// Noise in blocks of a few pixels: many regions of every ink, as large as cells are.
TEST(TrackerNoise, NoiseHoldsNothing) {
  const Catalog catalog = catalog_of(8);
  Tracker tracker(catalog, {.independent = true});
  constexpr std::size_t width = 160, height = 120;
  std::mt19937 random(9);
  std::vector<std::uint8_t> bytes(3 * width * height);
  for (const std::size_t block : {1u, 6u, 11u}) {
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < 3 * width; ++x) {
        const std::size_t bx = x / 3 - x / 3 % block, by = y - y % block;
        const bool first = bx == x / 3 && by == y;
        bytes[3 * width * y + x] = first ? static_cast<std::uint8_t>(random()) : bytes[3 * width * by + 3 * bx + x % 3];
      }
    Picture picture;
    picture.width = width;
    picture.height = height;
    picture.planes[0] = bytes.data();
    picture.strides[0] = 3 * width;
    picture.intrinsics = Intrinsics::from_fov(width, height, 1);
    EXPECT_EQ(process(tracker, picture).marker_count, 0) << "blocks of " << block;
  }
}

TEST(TrackerCatalogue, WithoutMarkersNothingIsFound) {
  const Catalog catalog = catalog_of(1);
  const Shot shot = shoot(catalog.markers[0], about_middle({}, {0, 0, 340}));
  Tracker tracker{Catalog{}};
  EXPECT_EQ(process(tracker, shot.picture()).marker_count, 0);
}

}  // namespace
}  // namespace onestroke::test
