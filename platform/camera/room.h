#pragma once

#include "core/pose.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace onestroke {

/// The room behind the hands, drawn once as a panorama round the head at rest: what lies far away, so that the head's
/// turning matters and its sway does not. World axes as in light.h. Constant after construction; any thread.
class Room {
 public:
  /// Texture coordinates of a direction.
  struct Place {
    float x = 0, y = 0;
  };

  /// How much of the panorama to draw; directions beyond it repeat its edge.
  struct Extent {
    double half_turn = 1.4;     ///< rad to either side of straight ahead
    double half_height = 1.15;  ///< tangent of the highest and the lowest elevation
  };

  /// focal_px: texels per radian; the camera's focal length or less. Takes some tenths of a second for all of it.
  Room(double focal_px, std::uint64_t seed, const Extent& extent);
  Room(double focal_px, std::uint64_t seed) : Room(focal_px, seed, Extent{}) {}

  Place place(Vec3 direction_world) const;
  /// n pixels of four floats (linear red, green, blue and one spare), along the straight line from a towards b, whose
  /// n-th step would be b.
  void draw(Place a, Place b, std::size_t n, float* out) const;

 private:
  void soften(std::vector<float>& light, double focal_px);

  Extent extent_;

  int width_ = 0, height_ = 0;
  float scale_ = 0;
  std::vector<std::uint16_t> texels_;  ///< Four a texel: red, green, blue, unused; 8192 is 1.
};

}  // namespace onestroke
