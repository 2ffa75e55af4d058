#pragma once

#include "core/picture.h"
#include "marker/catalog.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace onestroke::bench {

/// Sixteen markers, two of which are in the pictures.
Catalog bench_catalog();
inline constexpr int markers_in_sight = 2;
inline constexpr int tags_in_sight = 2;

/// Pictures of one camera, taken 30 times a second while both markers swing; the last leads back to the first. Two
/// black and white tags (AprilTag 36h11) with wide white borders stand in the corners for the yardsticks.
class BenchPictures {
 public:
  BenchPictures(int width, int height, double horizontal_fov_rad);

  std::size_t count() const { return rgb_.size(); }
  /// The picture that follows number - 1: times rise without end, pictures come round again.
  Picture picture(std::uint64_t number) const;
  const std::vector<std::uint8_t>& rgb(std::size_t i) const { return rgb_[i]; }
  /// The first picture in grey, rows of width bytes.
  const std::vector<std::uint8_t>& gray() const { return gray_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  void draw(double fov);
  void paste_tags(std::vector<std::uint8_t>& rgb) const;

  int width_, height_;
  Intrinsics intrinsics_;
  std::vector<std::vector<std::uint8_t>> rgb_;
  std::vector<std::uint8_t> gray_;
};

}  // namespace onestroke::bench
