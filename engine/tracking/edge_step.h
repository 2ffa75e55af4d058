#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace onestroke {

/// A blurred step between two colours, fitted by least squares to samples along a line across an edge, from -reach to
/// reach: sums of the samples by its weights tell where the edge lies, in units of the reach.
struct EdgeStep {
  static constexpr int samples = 9;
  static constexpr double spacing = 2.0 / samples;
  /// Of the fitted step.
  static constexpr double blur = 0.4;
  /// The blur of the fitted step and the picture's own together lie between these.
  static constexpr float min_blur = 0.4F, max_blur = 0.95F;

  std::array<float, samples> weight{};  ///< The step's derivative.
  float weights = 0, level = 0;         ///< Sums of the weights, and of the heights by their weights.
  /// Weights whose sum over a step tells by how much the offset that is found for it grows with the offset that it has:
  /// as much where it is as wide as this one, more where it is steeper.
  std::array<float, samples> gain{};
  /// The offset that is found for a step in its place where the colour past it rises by the step's own height from one
  /// reach away to two, and as evenly before.
  float ramp = 0;
  EdgeStep() {
    double square = 0;
    std::array<double, samples> slope{}, height{};
    for (std::size_t i = 0; i < samples; ++i) {
      const double x = spacing * (static_cast<double>(i) - samples / 2), z = x / blur;
      height[i] = 0.5 * std::erfc(-z * std::numbers::sqrt2 / 2);
      slope[i] = std::exp(-0.5 * z * z) / (blur * std::sqrt(2 * std::numbers::pi));
      square += slope[i] * slope[i];
    }
    for (std::size_t i = 0; i < samples; ++i) {
      weight[i] = static_cast<float>(-slope[i] / square);
      weights += weight[i];
      level += weight[i] * static_cast<float>(height[i]);
    }
    double own = 0;
    for (std::size_t i = 0; i < samples; ++i) {
      gain[i] = (i + 1 < samples ? weight[i + 1] : 0) - (i > 0 ? weight[i - 1] : 0);
      own += static_cast<double>(gain[i]) * height[i];
    }
    for (float& g : gain) g /= static_cast<float>(own);
    for (std::size_t i = 0; i < samples; ++i) {
      const double x = spacing * (static_cast<double>(i) - samples / 2);
      ramp += weight[i] * static_cast<float>(height[i] * (x - 1));
    }
  }

  /// Where a Gaussian step lies for which the weights found an offset and a gain, whatever its own blur: they found the
  /// integral of a Gaussian of both blurs together, and its slope.
  static float offset(float found, float gained) {
    constexpr auto scale = static_cast<float>(2 * blur / std::numbers::inv_sqrtpi);
    const float share = std::clamp(found * (1 / scale), -0.45F, 0.45F), square = share * share;
    // The quantile of the normal distribution, as its series goes (Pade).
    constexpr float root = 2.50663F;
    const float quantile = root * share * (1 - 1.152F * square) / (1 - 2.2F * square);
    // The density there, as a polynomial fitted to it.
    const float density = 1.0002F - square * (3.1757F + square * (0.847F + square * 7.545F));
    const float slope = scale / root * density;
    return quantile * (gained * max_blur < slope ? max_blur : std::max(min_blur, slope / gained));
  }
};

}  // namespace onestroke
