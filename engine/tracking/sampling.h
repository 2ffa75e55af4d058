#pragma once

#include "tracking/image_view.h"

#include <opencv2/core/hal/intrin.hpp>

#include <utility>

namespace onestroke {

/// Red, green and blue in one vector, and a fourth lane that means nothing.
using ColorLanes = cv::v_float32x4;

/// ImageView::sample, all channels at once; its scalar twin to the last bit.
inline ColorLanes sample_lanes(const ImageView& image, double u, double v) {
  const double x = u - 0.5, y = v - 0.5;
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  // After the picture's last pixel there may be no more bytes.
  if (x0 + 2 >= image.width && y0 + 2 >= image.height) {
    const Color c = image.sample(u, v);
    return {c[0], c[1], c[2], 0};
  }
  const std::uint8_t* p = image.at(x0, y0);
  // Two pixels and two bytes of a third, of each row.
  const auto pixels = [](const std::uint8_t* at) {
    const cv::v_uint16x8 both = cv::v_load_expand(at);
    const auto one = [](const cv::v_uint16x8& of) {
      return cv::v_cvt_f32(cv::v_reinterpret_as_s32(cv::v_expand_low(of)));
    };
    return std::pair(one(both), one(cv::v_rotate_right<3>(both)));
  };
  const auto [p0, p1] = pixels(p);
  const auto [q0, q1] = pixels(p + image.stride);
  const ColorLanes fx = cv::v_setall_f32(static_cast<float>(x - x0)), fy = cv::v_setall_f32(static_cast<float>(y - y0));
  const ColorLanes above = p0 + fx * (p1 - p0), below = q0 + fx * (q1 - q0);
  return above + fy * (below - above);
}

inline Color to_color(const ColorLanes& lanes) {
  float c[4];
  cv::v_store(c, lanes);
  return {c[0], c[1], c[2]};
}

}  // namespace onestroke
