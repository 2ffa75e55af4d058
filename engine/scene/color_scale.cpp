#include "scene/color_scale.h"

#include "core/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace onestroke {

namespace {

constexpr std::array<std::array<std::uint8_t, 3>, 11> steps{{{45, 0, 75},
                                                             {84, 39, 136},
                                                             {128, 115, 172},
                                                             {178, 171, 210},
                                                             {216, 218, 235},
                                                             {247, 247, 247},
                                                             {254, 224, 182},
                                                             {253, 184, 99},
                                                             {224, 130, 20},
                                                             {179, 88, 6},
                                                             {127, 59, 8}}};

}  // namespace

ColorScale ColorScale::for_distances(double p95, double least) {
  if (!(p95 > least)) return ColorScale(least);
  const double power = std::pow(10, std::floor(std::log10(p95)));
  for (const double times : {1.0, 2.0, 5.0})
    // What rounding puts a little above a step belongs to it.
    if (times * power * (1 + 1e-9) >= p95) return ColorScale(times * power);
  return ColorScale(10 * power);
}

std::array<float, 3> ColorScale::color(double distance) const {
  const double place = std::clamp(distance / reach_, -1.0, 1.0) * 5 + 5;
  const auto first = std::min(static_cast<std::size_t>(place), steps.size() - 2);
  const auto share = static_cast<float>(place - static_cast<double>(first));
  std::array<float, 3> mixed;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto linear = [i](std::size_t step) { return linear_from_srgb(static_cast<float>(steps[step][i]) / 255); };
    mixed[i] = (1 - share) * linear(first) + share * linear(first + 1);
  }
  return mixed;
}

}  // namespace onestroke
