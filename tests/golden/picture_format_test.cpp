// Camera formats, against the same sums done here.
#include "golden/stage.h"

#include <algorithm>
#include <cmath>

namespace onestroke::golden {
namespace {

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

/// The pattern in a format, with the memory behind it. Rows have a few bytes more than they need.
struct Pattern {
  std::vector<std::uint8_t> first, second{};
  onestroke::Picture picture{};

  explicit Pattern(PixelFormat format) {
    picture.width = w;
    picture.height = h;
    picture.format = format;
    picture.intrinsics = Intrinsics::from_fov(w, h, 0.9);
    switch (format) {
      case PixelFormat::rgb8:
        fill(0, first, 3, h, [](int x, int y, int c) {
          return rgb(luma(x, y), chroma_u(x, y), chroma_v(x, y))[static_cast<std::size_t>(c)];
        });
        break;
      case PixelFormat::gray8:
        fill(0, first, 1, h, [](int x, int y, int) { return luma(x, y); });
        break;
      case PixelFormat::yuyv:
        fill(0, first, 2, h, [](int x, int y, int c) { return c == 0 ? luma(x, y) : chroma(x, y); });
        break;
      case PixelFormat::nv12:
        fill(0, first, 1, h, [](int x, int y, int) { return luma(x, y); });
        fill(1, second, 1, h / 2, [](int x, int y, int) { return chroma(x, 2 * y); });
    }
  }
  Pattern(const Pattern&) = delete;

 private:
  static int chroma(int x, int y) { return x % 2 ? chroma_v(x, y) : chroma_u(x, y); }

  template <typename ByteOf>
  void fill(std::size_t plane, std::vector<std::uint8_t>& bytes, int per_pixel, int rows, const ByteOf& byte_of) {
    const std::size_t stride = static_cast<std::size_t>(per_pixel * w) + 6;
    bytes.resize(stride * static_cast<std::size_t>(rows));
    for (int y = 0; y < rows; ++y)
      for (int i = 0; i < per_pixel * w; ++i)
        bytes[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(byte_of(i / per_pixel, y, i % per_pixel));
    picture.planes[plane] = bytes.data();
    picture.strides[plane] = stride;
  }
};

/// Pixel for pixel, against `wanted` of a place.
template <typename Wanted>
void expect_colors(const Picture& drawn, const Wanted& wanted) {
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::array<int, 3> color = wanted(x, y);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(drawn.at(x, y)[c], color[static_cast<std::size_t>(c)], 1) << x << " " << y << " " << c;
    }
}

class PictureFormat : public Stage {
 protected:
  /// Checks the sums, and how the picture looks when it is enlarged.
  template <typename Wanted>
  void check(PixelFormat format, const std::string& name, const Wanted& wanted) {
    const Pattern pattern(format);
    renderer->set_picture(pattern.picture);
    const View view{.fov = fov_of(pattern.picture.intrinsics, w, h), .viewport = {0, 0, w, h}};
    expect_colors(draw({}, {&view, 1}), wanted);
    expect_golden(name, draw({}), {.level = 2, .pixels = 30});
  }
};

TEST_F(PictureFormat, Rgb) {
  check(PixelFormat::rgb8, "format_rgb", [](int x, int y) { return rgb(luma(x, y), chroma_u(x, y), chroma_v(x, y)); });
}

TEST_F(PictureFormat, Gray) {
  check(PixelFormat::gray8, "format_gray", [](int x, int y) { return std::array{luma(x, y), luma(x, y), luma(x, y)}; });
}

TEST_F(PictureFormat, Nv12) {
  check(PixelFormat::nv12, "format_nv12",
        [](int x, int y) { return rgb(luma(x, y), chroma_u(x, y / 2 * 2), chroma_v(x, y / 2 * 2)); });
}

TEST_F(PictureFormat, Yuyv) {
  check(PixelFormat::yuyv, "format_yuyv", [](int x, int y) { return rgb(luma(x, y), chroma_u(x, y), chroma_v(x, y)); });
}

}  // namespace
}  // namespace onestroke::golden
