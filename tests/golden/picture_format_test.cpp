// Camera formats with subsampled colour, against the same sums done here.
#include "golden/stage.h"

#include <algorithm>
#include <cmath>

namespace onestroke::golden {
namespace {

using PictureFormat = Stage;

// Not multiples of four, so that the last pixels of a row share words with nothing.
constexpr int w = 70, h = 34;

/// Smooth in brightness; colour changes from one pair of rows and columns to the next.
int luma(int x, int y) {
  return 30 + (x * 3 + y * 5) % 200;
}
int chroma_u(int x, int y) {
  return 60 + (x / 2 * 7 + y / 2 * 3) % 130;
}
int chroma_v(int x, int y) {
  return 70 + (x / 2 * 5 + y / 2 * 11) % 120;
}

/// ITU-R BT.601, limited range.
std::array<int, 3> rgb(int y, int u, int v) {
  const double l = (y - 16) * 255.0 / 219, cu = (u - 128) * 255.0 / 224, cv = (v - 128) * 255.0 / 224;
  const auto level = [](double value) { return static_cast<int>(std::lround(std::clamp(value, 0.0, 255.0))); };
  return {level(l + 1.402 * cv), level(l - 0.344136 * cu - 0.714136 * cv), level(l + 1.772 * cu)};
}

onestroke::Picture picture_of(PixelFormat format, const std::vector<std::uint8_t>& first, std::size_t stride) {
  onestroke::Picture p;
  p.width = w;
  p.height = h;
  p.format = format;
  p.planes[0] = first.data();
  p.strides[0] = stride;
  p.intrinsics = Intrinsics::from_fov(w, h, 0.9);
  return p;
}

void expect_colors(const Picture& drawn, int rows_per_chroma) {
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const int chroma_row = rows_per_chroma == 2 ? y / 2 * 2 : y;
      const auto wanted = rgb(luma(x, y), chroma_u(x, chroma_row), chroma_v(x, chroma_row));
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(drawn.at(x, y)[c], wanted[static_cast<std::size_t>(c)], 1) << x << " " << y << " " << c;
    }
}

View view_of(const onestroke::Picture& p) {
  return {.T_world_view = {}, .fov = fov_of(p.intrinsics, w, h), .viewport = {0, 0, w, h}};
}

TEST_F(PictureFormat, Nv12) {
  constexpr std::size_t stride = w + 10;
  std::vector<std::uint8_t> y_plane(stride * h), uv_plane(stride * h / 2);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const auto row = static_cast<std::size_t>(y), column = static_cast<std::size_t>(x);
      y_plane[row * stride + column] = static_cast<std::uint8_t>(luma(x, y));
      uv_plane[row / 2 * stride + column] =
          static_cast<std::uint8_t>(x % 2 ? chroma_v(x, y / 2 * 2) : chroma_u(x, y / 2 * 2));
    }
  auto p = picture_of(PixelFormat::nv12, y_plane, stride);
  p.planes[1] = uv_plane.data();
  p.strides[1] = stride;
  renderer->set_picture(p);
  const View view = view_of(p);
  expect_colors(draw({}, {&view, 1}), 2);
}

TEST_F(PictureFormat, Yuyv) {
  constexpr std::size_t stride = 2 * w + 6;
  std::vector<std::uint8_t> bytes(stride * h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * stride + 2 * static_cast<std::size_t>(x);
      bytes[at] = static_cast<std::uint8_t>(luma(x, y));
      bytes[at + 1] = static_cast<std::uint8_t>(x % 2 ? chroma_v(x, y) : chroma_u(x, y));
    }
  const auto p = picture_of(PixelFormat::yuyv, bytes, stride);
  renderer->set_picture(p);
  const View view = view_of(p);
  expect_colors(draw({}, {&view, 1}), 1);
}

}  // namespace
}  // namespace onestroke::golden
