#include "tracking/inks.h"

#include "tracking/ink_matcher.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

float Inks::spread() const {
  return std::max(0.02F, 0.18F * separation);
}

float Inks::variance(float noise) const {
  return spread() * spread() + noise * noise;
}

Inks::Match Inks::match(const Color& color, int expected) const {
  const float sum = color.sum();
  if (sum < min_sum) return Match::unknown;
  const Color c = chromaticity(color);
  int nearest = -1;
  float best = 1e9F;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!known[k]) continue;
    const Color off = c - chroma[k];
    const float square = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
    if (square >= best) continue;
    best = square;
    nearest = i;
  }
  if (nearest < 0) return Match::unknown;
  const float reach = (nearest == expected ? expected_reach : other_reach) * separation;
  if (best >= reach * reach) return Match::unknown;
  return nearest == expected ? Match::agrees : Match::contradicts;
}

InkMatcher::InkMatcher(const Inks& inks)
    : agreeing_(Inks::expected_reach * inks.separation), contradicting_(Inks::other_reach * inks.separation) {
  agreeing_ *= agreeing_;
  contradicting_ *= contradicting_;
  for (std::size_t i = 0; i < chroma_.size(); ++i)
    chroma_[i] = inks.known[i] ? to_lanes(inks.chroma[i]) : cv::v_setall_f32(far_off);
}

void InkSamples::add(int ink, const Color& color) {
  sum_[static_cast<std::size_t>(ink)] += chromaticity(color);
  ++count_[static_cast<std::size_t>(ink)];
}

void Inks::set(int ink, const Color& value) {
  chroma[static_cast<std::size_t>(ink)] = value;
  known[static_cast<std::size_t>(ink)] = true;
  separation = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!known[i] || !known[j]) continue;
      const float d = (chroma[i] - chroma[j]).matrix().norm();
      separation = separation > 0 ? std::min(separation, d) : d;
    }
}

Inks InkSamples::mean() const {
  Inks inks;
  for (std::size_t i = 0; i < 3; ++i)
    if (count_[i] > 0) inks.set(static_cast<int>(i), sum_[i] / static_cast<float>(count_[i]));
  return inks;
}

}  // namespace onestroke
