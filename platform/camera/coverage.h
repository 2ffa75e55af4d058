#pragma once

#include "camera/pose_path.h"
#include "camera/rod.h"
#include "core/picture.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace onestroke {

/// Which pixels of which rows a moving thing may touch: for each thing a first and a last column a row. Only these
/// pixels cast rays at it.
class Coverage {
 public:
  struct Span {
    std::int32_t first = 0, last = -1;  ///< Inclusive; last < first where the row is free of it.
  };

  /// Forgets all things. Allocates only while pictures or their content grow.
  void reset(const Intrinsics& intrinsics, int width, int height);
  /// Adds a thing that the balls of its own frame cover, along the whole path; things are numbered from 0.
  void add(std::span<const Ball> balls, const PosePath& T_camera_thing);

  std::size_t things() const { return things_; }
  Span at(std::size_t thing, int row) const {
    return spans_[thing * static_cast<std::size_t>(height_) + static_cast<std::size_t>(row)];
  }

 private:
  struct Box {
    double left = 0, right = 0, top = 0, bottom = 0;
  };
  /// False where the ball lies behind the camera.
  bool bound(Vec3 centre, double radius, Box& box) const;
  void mark(std::span<Span> rows, const Box& box) const;

  Intrinsics intrinsics_;
  int width_ = 0, height_ = 0;
  std::size_t things_ = 0;
  std::vector<Span> spans_;
};

}  // namespace onestroke
