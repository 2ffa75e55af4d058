#pragma once

#include "tracking/inks.h"
#include "tracking/sampling.h"

#include <array>

namespace onestroke {

/// Inks made ready for many colours in lanes; Inks::match is its scalar twin.
class InkMatcher {
 public:
  explicit InkMatcher(const Inks& inks);

  Inks::Match match(const ColorLanes& color, int expected) const {
    const ColorLanes rgb = without_rest(color);
    const float sum = cv::v_reduce_sum(rgb);
    if (sum < Inks::min_sum) return Inks::Match::unknown;
    // All times the sum, which saves a division.
    const ColorLanes whole = cv::v_setall_f32(sum + 1e-3F);
    const auto square = [&](std::size_t i) {
      const ColorLanes off = rgb - whole * chroma_[i];
      return off * off;
    };
    const ColorLanes far = cv::v_setall_f32(1e30F);
    const ColorLanes squares = cv::v_reduce_sum4(square(0), square(1), square(2), far);
    float by_ink[4];
    cv::v_store(by_ink, squares);
    const float nearest = cv::v_reduce_min(squares);
    if (by_ink[expected] <= nearest)
      return nearest < agreeing_ * sum * sum ? Inks::Match::agrees : Inks::Match::unknown;
    return nearest < contradicting_ * sum * sum ? Inks::Match::contradicts : Inks::Match::unknown;
  }

 private:
  static constexpr float far_off = 1e6F;

  std::array<ColorLanes, 3> chroma_;
  float agreeing_, contradicting_;  // Squares of how far an ink reaches.
};

}  // namespace onestroke
