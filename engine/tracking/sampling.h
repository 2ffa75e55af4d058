#pragma once

#include "tracking/image_view.h"

#include <opencv2/core/hal/intrin.hpp>

namespace onestroke {

/// Red, green and blue in one vector, and a fourth lane that means nothing.
using ColorLanes = cv::v_float32x4;

/// A place in a picture, or a step from one to another, in whole numbers.
struct PicturePoint {
  static constexpr int bits = 15;
  int x = 0, y = 0;

  static PicturePoint step(double u, double v) {
    return {static_cast<int>(u * (1 << bits)), static_cast<int>(v * (1 << bits))};
  }
  /// Of a pixel's centre: whole.
  static PicturePoint at(double u, double v) { return step(u - 0.5, v - 0.5); }
  PicturePoint& operator+=(const PicturePoint& d) {
    x += d.x;
    y += d.y;
    return *this;
  }
};

/// sample_lanes() in the last two pixels of the last two rows, after which there may be no more bytes.
[[gnu::cold]] ColorLanes sample_corner(const ImageView& image, const PicturePoint& p);

/// ImageView::sample, all channels at once, in whole numbers: its scalar twin at a place rounded down to 1 / 4096
/// of a pixel.
inline ColorLanes sample_lanes(const ImageView& image, const PicturePoint& at) {
  // Weights are products of two numbers of this many bits each.
  constexpr int bits = 12, spare = 2, whole = 1 << (bits + spare);
  const int x0 = at.x >> PicturePoint::bits, y0 = at.y >> PicturePoint::bits;
  if (x0 + 2 >= image.width && y0 + 2 >= image.height) [[unlikely]]
    return sample_corner(image, at);
  constexpr int shift = PicturePoint::bits - bits, mask = (1 << bits) - 1;
  const int fx = (at.x >> shift) & mask, fy = (at.y >> shift) & mask;
  const int both = (fx * fy) >> (bits - spare), right = (fx << spare) - both, below = (fy << spare) - both;
  // Two pixels and two bytes of a third, of each row; two weights in one.
  const auto row = [](const std::uint8_t* from, int left_weight, int right_weight) {
    const cv::v_uint8x16 bytes = cv::v_load_low(from);
    cv::v_uint8x16 pairs, rest;
    cv::v_zip(bytes, cv::v_rotate_right<3>(bytes), pairs, rest);
    return cv::v_dotprod(cv::v_reinterpret_as_s16(cv::v_expand_low(pairs)),
                         cv::v_reinterpret_as_s16(cv::v_setall_s32(left_weight | right_weight << 16)));
  };
  const std::uint8_t* p = image.at(x0, y0);
  const cv::v_int32x4 sum = row(p, whole - right - below - both, right) + row(p + image.stride, below, both);
  return cv::v_cvt_f32(sum) * cv::v_setall_f32(1.0F / whole);
}

inline ColorLanes sample_lanes(const ImageView& image, double u, double v) {
  return sample_lanes(image, PicturePoint::at(u, v));
}

/// The fourth lane 0.
inline ColorLanes without_rest(const ColorLanes& lanes) {
  return lanes & cv::v_reinterpret_as_f32(cv::v_int32x4(-1, -1, -1, 0));
}

inline ColorLanes to_lanes(const Color& c) {
  return {c[0], c[1], c[2], 0};
}

}  // namespace onestroke
