#pragma once

#include "camera/light.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace onestroke {

/// Turns linear light into the 8-bit values a camera writes: gain, white balance left as it is, noise, sRGB transfer.
class Sensor {
 public:
  Sensor();

  /// noise: standard deviation at mid grey, levels of 255. Cheap where nothing changes.
  void set(double noise, double gain, double light_kelvin);
  /// n pixels of four floats (the fourth unused) to n of three bytes. seed chooses the row's noise.
  void develop(const float* light, std::size_t n, std::uint64_t seed, std::uint8_t* rgb) const;

 private:
  struct Step {
    float level = 0, deviation = 0;
  };

  double noise_ = -1, gain_ = 0, kelvin_ = 0;
  float channel_gain_[3] = {1, 1, 1};
  std::vector<Step> response_;
  std::vector<float> gauss_;
};

/// Mixes the bits of a number well (splitmix64).
constexpr std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace onestroke
