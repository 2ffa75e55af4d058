#pragma once

#include "core/picture.h"
#include "marker/catalog.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace onestroke::bench {

/// Sixteen markers, some of which are in the pictures.
Catalog bench_catalog();
inline constexpr int tags_in_sight = 2;

/// What a round of pictures shows.
struct Scene {
  enum class Background { plain, room, confetti };

  int width = 1600, height = 1200;
  double fov_deg = 35;
  /// Two are held some 440 mm away, as in two hands; any other number, up to 16, stands in a grid 750 mm away.
  int markers = 2;
  Background background = Background::room;
  /// Two black and white tags (AprilTag 36h11) with wide white borders stand in the corners for the yardsticks.
  bool tags = true;
  /// The two also stand in the grid.
  bool grid = false;

  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Pictures of one camera, taken 30 times a second while all markers swing; the last leads back to the first.
class BenchPictures {
 public:
  explicit BenchPictures(const Scene& scene);

  const Scene& scene() const { return scene_; }
  std::size_t count() const { return rgb_.size(); }
  /// The picture that follows number - 1: times rise without end, pictures come round again.
  Picture picture(std::uint64_t number) const;
  const std::vector<std::uint8_t>& rgb(std::size_t i) const { return rgb_[i]; }
  /// The first picture in grey, rows of width bytes.
  const std::vector<std::uint8_t>& gray() const { return gray_; }
  int width() const { return scene_.width; }
  int height() const { return scene_.height; }

 private:
  void draw();
  void paste_tags(std::vector<std::uint8_t>& rgb) const;

  Scene scene_;
  Intrinsics intrinsics_;
  std::vector<std::vector<std::uint8_t>> rgb_;
  std::vector<std::uint8_t> gray_;
};

}  // namespace onestroke::bench
