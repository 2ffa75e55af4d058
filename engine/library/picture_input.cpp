#include "library/picture_input.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace onestroke {
namespace {

constexpr int max_side = 16384;
constexpr std::int64_t max_span_ns = 10'000'000'000;
// Leaves room for adding spans.
constexpr std::int64_t max_time_ns = std::int64_t{1} << 62;

void require(bool good, const std::string& message) {
  if (!good) throw ArgumentError(message);
}

void check_span(const char* name, std::int64_t ns) {
  require(ns >= 0 && ns <= max_span_ns,
          std::string("picture: ") + name + " must be 0 to 10 s, not " + std::to_string(ns) + " ns");
}

void check_times(const CameraPicture& p) {
  require(p.exposure_start_ns >= -max_time_ns && p.exposure_start_ns <= max_time_ns,
          "picture: exposure_start_ns is out of range: " + std::to_string(p.exposure_start_ns));
  check_span("exposure_length_ns", p.exposure_length_ns);
  check_span("readout_ns", p.readout_ns);
}

void check_size(const CameraPicture& p) {
  require(std::min(p.width, p.height) >= 1 && std::max(p.width, p.height) <= max_side,
          "picture: width and height must be 1 to " + std::to_string(max_side) + ", not " + std::to_string(p.width) +
              " x " + std::to_string(p.height));
  const bool even_width = p.layout == PictureLayout::nv12 || p.layout == PictureLayout::yuyv;
  require(!even_width || p.width % 2 == 0, "picture: this layout needs an even width, not " + std::to_string(p.width));
  require(p.layout != PictureLayout::nv12 || p.height % 2 == 0,
          "picture: nv12 needs an even height, not " + std::to_string(p.height));
}

void check_stride(const char* name, std::size_t stride, std::size_t row) {
  require(stride >= row, std::string("picture: ") + name + " is " + std::to_string(stride) + " bytes, but a row has " +
                             std::to_string(row));
}

PixelFormat to_format(PictureLayout layout) {
  switch (layout) {
    case PictureLayout::rgb:
      return PixelFormat::rgb8;
    case PictureLayout::gray:
      return PixelFormat::gray8;
    case PictureLayout::nv12:
      return PixelFormat::nv12;
    case PictureLayout::yuyv:
      return PixelFormat::yuyv;
  }
  throw ArgumentError("picture: layout " + std::to_string(static_cast<int>(layout)) +
                      " is unknown; it must be rgb (0), gray (1), nv12 (2) or yuyv (3)");
}

std::size_t bytes_a_row(const CameraPicture& p) {
  const auto width = static_cast<std::size_t>(p.width);
  if (p.layout == PictureLayout::rgb) return 3 * width;
  return p.layout == PictureLayout::yuyv ? 2 * width : width;
}

void set_planes(const CameraPicture& p, Picture& picture) {
  const std::size_t row = bytes_a_row(p);
  require(p.data != nullptr, "picture: data is null");
  check_stride("stride", p.stride, row);
  picture.planes[0] = p.data;
  picture.strides[0] = p.stride;
  if (p.layout != PictureLayout::nv12) return;
  picture.strides[1] = p.uv_stride != 0 ? p.uv_stride : p.stride;
  check_stride("uv_stride", picture.strides[1], row);
  picture.planes[1] = p.uv_data != nullptr ? p.uv_data : p.data + p.stride * static_cast<std::size_t>(p.height);
}

// OpenCV counts from the centre of the first pixel, the tracker from its corner.
Intrinsics to_intrinsics(const CameraLens& lens, int width, int height) {
  if (lens.horizontal_fov_deg != 0)
    return Intrinsics::from_fov(width, height, lens.horizontal_fov_deg * std::numbers::pi / 180);
  return {lens.fx, lens.fy, lens.cx + 0.5, lens.cy + 0.5, lens.distortion};
}

bool focal(double f) {
  return f >= 1 && f <= 1e6;
}

bool finite(double x) {
  return std::abs(x) <= 1e6;
}

}  // namespace

void check_lens(const CameraLens& lens) {
  if (lens.horizontal_fov_deg != 0) {
    require(lens.horizontal_fov_deg >= 1 && lens.horizontal_fov_deg <= 179,
            "lens: horizontal_fov_deg must be 1 to 179, not " + std::to_string(lens.horizontal_fov_deg));
    return;
  }
  require(focal(lens.fx) && focal(lens.fy), "lens: give horizontal_fov_deg, or fx and fy in pixels; they are " +
                                                std::to_string(lens.fx) + " and " + std::to_string(lens.fy));
  require(
      std::max(lens.fx, lens.fy) <= 4 * std::min(lens.fx, lens.fy),
      "lens: fx and fy differ by more than any lens: " + std::to_string(lens.fx) + " and " + std::to_string(lens.fy));
  require(finite(lens.cx) && finite(lens.cy),
          "lens: cx and cy must be pixels, not " + std::to_string(lens.cx) + " and " + std::to_string(lens.cy));
  require(std::ranges::all_of(lens.distortion, finite), "lens: one of distortion is no number that a lens can have");
}

Picture to_picture(const CameraPicture& p, const CameraLens& lens) {
  Picture picture;
  picture.format = to_format(p.layout);
  check_size(p);
  check_times(p);
  set_planes(p, picture);
  picture.width = p.width;
  picture.height = p.height;
  picture.sequence = p.sequence;
  picture.exposure = {{p.exposure_start_ns}, {p.exposure_length_ns}, {p.readout_ns}};
  picture.intrinsics = to_intrinsics(lens, p.width, p.height);
  return picture;
}

}  // namespace onestroke
