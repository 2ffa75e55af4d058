#pragma once

#include "camera/light.h"

#include <array>
#include <cstdint>
#include <vector>

namespace onestroke {

/// The things that stand in the room and their paint: what a ray from the head at rest meets. The head looks a little
/// down, at a desk with a wall behind it. Millimetres.
class RoomScene {
 public:
  struct Sight {
    Linear light;
    float distance = 0;  ///< mm
  };

  /// The seed chooses the books and the plant's leaves.
  explicit RoomScene(std::uint64_t seed);
  /// direction: world axes, any length.
  Sight look(Vec3 direction) const;

 private:
  struct Book {
    float left = 0, right = 0, height = 0;
    Linear cover, band;
  };
  /// An ellipse in the plant's plane.
  struct Leaf {
    float x = 0, y = 0, length = 0, width = 0, cosine = 1, sine = 0, shade = 1;
  };
  static constexpr std::size_t boards = 3;

  bool near_things(Vec3 ray, Sight& out) const;
  bool shelf(float x, float y, Linear& out) const;
  bool plant(float x, float y, Linear& out) const;
  Linear back_wall(float x, float y) const;

  std::array<std::vector<Book>, boards> books_;
  std::vector<Leaf> leaves_;
};

}  // namespace onestroke
