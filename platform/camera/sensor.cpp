#include "camera/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onestroke {
namespace {

constexpr int steps = 8192;
constexpr std::size_t gauss_count = 1 << 16;

double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_slope(double linear) {
  return linear <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(linear, 1 / 2.4 - 1);
}

double uniform(std::uint64_t index) {
  return (static_cast<double>(scramble(index) >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

Sensor::Sensor() : response_(steps), gauss_(gauss_count) {
  for (std::size_t i = 0; i < gauss_count; i += 2) {
    const double r = std::sqrt(-2 * std::log(uniform(i))), a = 2 * std::numbers::pi * uniform(i + 1);
    gauss_[i] = static_cast<float>(r * std::cos(a));
    gauss_[i + 1] = static_cast<float>(r * std::sin(a));
  }
}

void Sensor::set(double noise, double gain, double light_kelvin) {
  if (noise == noise_ && gain == gain_ && light_kelvin == kelvin_) return;
  noise_ = noise;
  gain_ = gain;
  kelvin_ = light_kelvin;
  const Linear white = white_of(light_kelvin);
  const float g = static_cast<float>(gain * (steps - 1));
  channel_gain_[0] = g * white.r;
  channel_gain_[1] = g * white.g;
  channel_gain_[2] = g * white.b;

  // Variance in linear light grows with the light (shot noise) from a floor (read noise), a tenth of it at mid grey.
  constexpr double mid = 0.2158605, floor_share = 0.1;
  const double at_mid = noise / (255 * srgb_slope(mid));
  for (int i = 0; i < steps; ++i) {
    const double light = static_cast<double>(i) / (steps - 1);
    const double variance = at_mid * at_mid * (floor_share + (1 - floor_share) * light / mid);
    response_[static_cast<std::size_t>(i)] = {static_cast<float>(255 * srgb(light) + 0.5),
                                              static_cast<float>(255 * srgb_slope(light) * std::sqrt(variance))};
  }
}

void Sensor::develop(const float* light, std::size_t n, std::uint64_t seed, std::uint8_t* rgb) const {
  std::size_t next = static_cast<std::size_t>(scramble(seed)) % gauss_count;
  const float* gauss = gauss_.data();
  const Step* response = response_.data();
  for (std::size_t x = 0; x < n; ++x) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float v = std::min(light[4 * x + c] * channel_gain_[c], static_cast<float>(steps - 1));
      const Step step = response[static_cast<int>(std::max(v, 0.0f))];
      const float level = step.level + step.deviation * gauss[next];
      next = (next + 1) % gauss_count;
      rgb[3 * x + c] = static_cast<std::uint8_t>(static_cast<int>(std::clamp(level, 0.0f, 255.0f)));
    }
  }
}

}  // namespace onestroke
