#pragma once

#include "tracking/image_view.h"

#include <array>

namespace onestroke {

/// How the three inks look in this light: their chromaticities, learnt from the cells themselves, so no white balance
/// is needed.
struct Inks {
  std::array<Color, 3> chroma{};
  std::array<bool, 3> known{};
  float separation = 0;  ///< Smallest distance between two known inks.

  void set(int ink, const Color& chromaticity);

  /// Of a component of the chromaticity that an ink shows, over the samples of one picture; `noise`: the standard
  /// deviation that the sample's own noise adds.
  float variance(float noise) const;
  /// The standard deviation of the same without noise.
  float spread() const;

  /// Below this sum of the levels the chromaticity is noise.
  static constexpr float min_sum = 12;
  /// Of the separation: how far from an ink's chromaticity a colour still is that ink, where it is expected and where
  /// not. Blur and veiling light pull a cell towards its neighbours and towards grey, hence the wider reach for the
  /// expected ink.
  static constexpr float expected_reach = 0.6F, other_reach = 0.4F;

  enum class Match { agrees, contradicts, unknown };
  /// Whether a colour is the expected ink, another ink, or none of them (skin, a highlight, background).
  Match match(const Color& color, int expected) const;
};

/// Inks that differ by less cannot be told apart.
inline constexpr float min_ink_separation = 0.02F;

/// Collects samples and averages them.
class InkSamples {
 public:
  void add(int ink, const Color& color);
  /// Needs two inks at least to be of use; separation is 0 otherwise.
  Inks mean() const;

 private:
  std::array<Color, 3> sum_{Color::Zero(), Color::Zero(), Color::Zero()};
  std::array<int, 3> count_{};
};

}  // namespace onestroke
