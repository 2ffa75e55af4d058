#include "app/overlay_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace onestroke {
namespace {

constexpr int width = 160, height = 120;

/// A picture of one colour.
struct Plain {
  std::vector<std::uint8_t> first, second;
  Picture picture;

  Plain(PixelFormat format, std::vector<std::uint8_t> pattern, std::vector<std::uint8_t> second_pattern = {}) {
    const auto fill = [](std::vector<std::uint8_t>& plane, const std::vector<std::uint8_t>& from, std::size_t bytes) {
      for (std::size_t i = 0; i < bytes; ++i) plane.push_back(from[i % from.size()]);
    };
    const std::size_t stride = width * (format == PixelFormat::rgb8 ? 3 : format == PixelFormat::yuyv ? 2 : 1);
    fill(first, pattern, stride * height);
    if (!second_pattern.empty()) fill(second, second_pattern, width * height / 2);
    picture.width = width;
    picture.height = height;
    picture.format = format;
    picture.planes = {first.data(), second.data()};
    picture.strides = {stride, width};
    picture.intrinsics = Intrinsics::from_fov(width, height, 0.6);
  }
};

std::array<int, 3> rgb(const Canvas& canvas, int x, int y) {
  const auto* p = canvas.rgba().data() + 4 * (y * canvas.width() + x);
  return {p[0], p[1], p[2]};
}

using Rgb = std::array<int, 3>;

TEST(Canvas, ReadsEveryFormat) {
  EXPECT_EQ(rgb(Canvas(Plain(PixelFormat::rgb8, {10, 20, 30}).picture), 159, 119), (Rgb{10, 20, 30}));
  EXPECT_EQ(rgb(Canvas(Plain(PixelFormat::gray8, {77}).picture), 3, 4), (Rgb{77, 77, 77}));
  // Full red in BT.601.
  EXPECT_EQ(rgb(Canvas(Plain(PixelFormat::nv12, {82}, {90, 240}).picture), 7, 9), (Rgb{255, 1, 0}));
  EXPECT_EQ(rgb(Canvas(Plain(PixelFormat::yuyv, {82, 90, 82, 240}).picture), 8, 9), (Rgb{255, 1, 0}));
}

TEST(Canvas, DrawsSmoothlyAndOnlyWhereAsked) {
  Canvas canvas(Plain(PixelFormat::gray8, {0}).picture);
  canvas.line(20, 60, 100, 60, 2, {255, 255, 255});
  EXPECT_EQ(rgb(canvas, 50, 59), (Rgb{255, 255, 255}));
  EXPECT_EQ(rgb(canvas, 50, 60), (Rgb{255, 255, 255}));
  EXPECT_EQ(rgb(canvas, 50, 57), (Rgb{0, 0, 0}));
  EXPECT_EQ(rgb(canvas, 104, 60), (Rgb{0, 0, 0}));
  canvas.dot(120.5, 30.5, 0.5, {200, 100, 0, 0.5});
  EXPECT_EQ(rgb(canvas, 120, 30), (Rgb{100, 50, 0}));
  canvas.box(10, 10, 12, 12, {9, 8, 7});
  EXPECT_EQ(rgb(canvas, 11, 11), (Rgb{9, 8, 7}));
  EXPECT_EQ(rgb(canvas, 13, 11), (Rgb{0, 0, 0}));
}

TEST(Canvas, CutsOffWhatLiesOutside) {
  Canvas canvas(Plain(PixelFormat::gray8, {0}).picture);
  canvas.line(-1e9, 20.5, 1e9, 20.5, 1, {255, 255, 255});
  canvas.line(NAN, 1, 5, 5, 1, {255, 255, 255});
  canvas.dot(-50, -50, 10, {255, 255, 255});
  canvas.text(-20, 110, 30, "outside", {255, 255, 255});
  EXPECT_EQ(rgb(canvas, 0, 20), (Rgb{255, 255, 255}));
  EXPECT_EQ(rgb(canvas, 159, 20), (Rgb{255, 255, 255}));
  EXPECT_EQ(rgb(canvas, 0, 0), (Rgb{0, 0, 0}));
}

TEST(Canvas, WritesWords) {
  Canvas canvas(Plain(PixelFormat::gray8, {0}).picture);
  canvas.text(10, 10, 40, "I", {255, 255, 255});
  int inked = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) inked += rgb(canvas, x, y)[0] > 127;
  // A stem: about 0.73 em high and 0.1 em wide.
  EXPECT_NEAR(inked, 0.73 * 40 * 0.1 * 40, 35);
  EXPECT_GT(Canvas::text_width(40, "II"), Canvas::text_width(40, "I"));
}

TEST(PixelOf, IsThePinholeWithDistortion) {
  Intrinsics k = Intrinsics::from_fov(1600, 1200, 35 * std::numbers::pi / 180);
  const auto centre = pixel_of(k, {0, 0, 500});
  EXPECT_DOUBLE_EQ(centre->u, 800);
  EXPECT_DOUBLE_EQ(centre->v, 600);
  EXPECT_NEAR(pixel_of(k, {100, 0, 500})->u, 800 + 2537.3 / 5, 0.01);
  EXPECT_FALSE(pixel_of(k, {0, 0, -500}));
  EXPECT_FALSE(pixel_of(k, {0, 0, 0}));
  k.distortion = {0.1, 0.02, 0.001, -0.002, 0.003};
  const double x = 0.2, y = -0.1, r2 = 0.05, radial = 1 + 0.1 * r2 + 0.02 * r2 * r2 + 0.003 * r2 * r2 * r2;
  const auto bent = pixel_of(k, {100, -50, 500});
  EXPECT_NEAR(bent->u, k.cx + k.fx * (x * radial + 2 * 0.001 * x * y - 0.002 * (r2 + 2 * x * x)), 1e-9);
  EXPECT_NEAR(bent->v, k.cy + k.fy * (y * radial + 0.001 * (r2 + 2 * y * y) - 2 * 0.002 * x * y), 1e-9);
}

TEST(OverlayDrawing, DrawsTheMarkerWhereItIs) {
  const Catalog catalog{{{7, "m07", encode(1, 36), Shape::angle(36, 4, 3, 0), ""}}};
  const Plain grey(PixelFormat::gray8, {100});
  FrameRecord record;
  record.marker_count = 2;
  MarkerObservation& m = record.markers[0];
  m.id = 7;
  std::strcpy(m.name.data(), "m07");
  m.state = MarkerState::measured;
  m.T_camera_marker = {{}, {-20, 20, 400}};
  m.cells_seen = 1;
  const auto seen = pixel_of(grey.picture.intrinsics, m.T_camera_marker * Vec3{0, -50, -3});
  m.cells[0] = {5, seen->u, seen->v};
  record.markers[1].id = 99;  // Not in the catalogue.
  record.markers[1].T_camera_marker = {{}, {40, 0, 400}};
  Canvas canvas(grey.picture);
  draw_overlay(canvas, grey.picture.intrinsics, catalog, record);
  const auto drawn = [&](double x, double y) {
    return rgb(canvas, static_cast<int>(x), static_cast<int>(y)) != Rgb{100, 100, 100};
  };
  EXPECT_TRUE(drawn(seen->u, seen->v));
  const auto origin = pixel_of(grey.picture.intrinsics, m.T_camera_marker.translation);
  EXPECT_TRUE(drawn(origin->u, origin->v));
  const auto on_x_axis = pixel_of(grey.picture.intrinsics, m.T_camera_marker * Vec3{22, 0, 0});
  const Rgb red = rgb(canvas, static_cast<int>(on_x_axis->u), static_cast<int>(on_x_axis->v));
  EXPECT_GT(red[0], red[1] + 50);
  EXPECT_FALSE(drawn(150, 60)) << "nothing stands there";
}

}  // namespace
}  // namespace onestroke
