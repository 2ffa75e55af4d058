#pragma once

#include "core/picture.h"
#include "render/picture_samples.h"

#include <array>
#include <cstdint>
#include <span>

namespace onestroke {

/// A ring of a stick that the tracker does not see though nothing of the stick itself hides it.
struct CoveredCell {
  Vec3 at{};      ///< Middle of the ring: camera frame (vision axes), mm.
  int stick = 0;  ///< Cells of one stick have one number.
};

/// Where fingers are in front of sticks. What covers a stick's ring is a finger if it has a colour that skin can have;
/// what has the same colour, and is joined to it, belongs to the same hand. One thread; no allocation after the
/// constructor.
class FingerMatte {
 public:
  /// Side of the matte, which the picture is scaled down to fit into.
  static constexpr int side = 256;
  /// No finger is farther from the ring that it covers, mm.
  static constexpr double reach = 55;

  /// The part of a picture that one stick's fingers take: pixels, and how far away they are.
  struct Finger {
    double left = 0, top = 0, right = 0, bottom = 0;
    double depth = 0;  ///< Of its front along the camera's axis, mm.
  };
  static constexpr std::size_t most_fingers = 4;

  /// Looks at the places that the cells take in the picture; an empty list makes an empty matte.
  void find(const Picture& picture, std::span<const CoveredCell> cells);

  std::span<const Finger> fingers() const { return {fingers_.data(), count_}; }
  /// Rows from the top, `side` bytes each; 255 is finger. A texel is as many pixels wide as high: scale().
  std::span<const std::uint8_t> alpha() const { return alpha_; }
  int scale() const { return scale_; }

 private:
  /// Colours of what covers one stick, as logarithms of the ratios of red and blue to green.
  struct Skin {
    float red = 0, blue = 0, red_spread = 0, blue_spread = 0, darkest = 0;
    bool like(const Rgb& coded) const;
  };
  struct Place {
    int x = 0, y = 0;
  };

  bool learn(const Picture& picture, std::span<const CoveredCell> cells, Skin& skin);
  void grow(const Picture& picture, const Skin& skin, double reach_px);
  void soften();
  Rgb mean_color(const Picture& picture, Place texel) const;

  std::array<std::uint8_t, std::size_t{side} * side> alpha_{}, grown_{};
  std::array<Place, std::size_t{side} * side> queue_{};
  std::array<Place, 64> seeds_{};
  std::size_t seed_count_ = 0, queued_ = 0;
  std::array<Finger, most_fingers> fingers_{};
  std::size_t count_ = 0;
  int scale_ = 1, width_ = 0, height_ = 0;
};

/// Whether skin, light or dark, can have a colour under the lights of rooms: red before green before blue, in bounds
/// that paint in red, green or blue is out of.
bool may_be_skin(const Rgb& coded);

}  // namespace onestroke
