#include "tracking/blur_search.h"

#include <array>
#include <limits>

namespace onestroke {
namespace {

// Of the nearness in the middle: depths that differ by less are blurred alike.
constexpr double least_range = 0.02;

using Ends = std::array<double, 2>;

CameraBlur through(const Ends& ends, const DepthRange& range, double middle) {
  const double slope = (ends[0] - ends[1]) / (middle / range.near - middle / range.far);
  return {ends[0] - slope * (middle / range.near - 1), slope, middle};
}

template <typename Allowed>
CameraBlur best_even(const CameraBlur& start, std::span<const double> sigmas, Allowed allowed, const BlurWorth& worth) {
  CameraBlur best{start.sigma, 0, start.middle};
  double most = std::numeric_limits<double>::lowest();
  for (const double sigma : sigmas) {
    if (!allowed(sigma, best.sigma)) continue;
    const CameraBlur tried{sigma, 0, start.middle};
    const double here = worth(tried);
    if (here <= most) continue;
    most = here;
    best = tried;
  }
  return best;
}

}  // namespace

CameraBlur best_even_blur(const CameraBlur& start, std::span<const double> sigmas, const BlurWorth& worth) {
  return best_even(
      start, sigmas, [](double, double) { return true; }, worth);
}

CameraBlur best_even_blur_near_by(const CameraBlur& start, std::span<const double> sigmas, const BlurWorth& worth) {
  return best_even(
      start, sigmas, [](double sigma, double best) { return sigma >= 0.6 * best && sigma <= 1.6 * best; }, worth);
}

CameraBlur best_blur_by_depth(const CameraBlur& start, const DepthRange& range, const EndBlurs& search,
                              const BlurWorth& worth) {
  if (start.middle / range.near - start.middle / range.far < least_range) return start;
  Ends ends{start.defocus(range.near), start.defocus(range.far)};
  double most = worth(start);
  for (int round = 0; round < search.rounds; ++round) {
    const Ends before = ends;
    for (std::size_t end = 0; end < ends.size(); ++end) {
      const double now = ends[end];
      for (const double candidate : search.candidates) {
        Ends tried = ends;
        tried[end] = search.relative ? candidate * now : candidate;
        if (std::abs(tried[end]) > search.widest) continue;
        const double here = worth(through(tried, range, start.middle));
        if (here <= most) continue;
        most = here;
        ends = tried;
      }
    }
    if (ends == before) break;
  }
  return through(ends, range, start.middle);
}

}  // namespace onestroke
