#include "camera/coverage.h"

#include "camera/lens.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

void Coverage::reset(const Intrinsics& intrinsics, int width, int height) {
  intrinsics_ = intrinsics;
  width_ = width;
  height_ = height;
  things_ = 0;
}

bool Coverage::bound(Vec3 c, double r, Box& box) const {
  constexpr double nearest = 5;  // mm: anything nearer may touch every pixel
  if (c.z + r < nearest) return false;
  if (c.z - r < nearest) {
    box = {0, static_cast<double>(width_), 0, static_cast<double>(height_)};
    return true;
  }
  // A bent lens may bulge a box's edge past its corners; the margin covers that for boxes as small as these.
  const double margin = intrinsics_.distorted() ? 2 : 0;
  box = {1e9, -1e9, 1e9, -1e9};
  for (const double z : {c.z - r, c.z + r}) {
    for (const double x : {c.x - r, c.x + r}) {
      for (const double y : {c.y - r, c.y + r}) {
        const Point2 p = distort(intrinsics_, {x / z, y / z});
        box = {std::min(box.left, p.x - margin), std::max(box.right, p.x + margin), std::min(box.top, p.y - margin),
               std::max(box.bottom, p.y + margin)};
      }
    }
  }
  return true;
}

void Coverage::mark(std::span<Span> rows, const Box& box) const {
  const auto pixel = [](double v, int size) {
    return static_cast<std::int32_t>(std::clamp(std::floor(v), -1.0, 1.0 * size));
  };
  const std::int32_t left = std::max(pixel(box.left, width_), 0),
                     right = std::min(pixel(box.right, width_), width_ - 1);
  const std::int32_t top = std::max(pixel(box.top, height_), 0);
  const std::int32_t bottom = std::min(pixel(box.bottom, height_), height_ - 1);
  if (left > right) return;
  for (std::int32_t y = top; y <= bottom; ++y) {
    Span& s = rows[static_cast<std::size_t>(y)];
    s = s.last < s.first ? Span{left, right} : Span{std::min(s.first, left), std::max(s.last, right)};
  }
}

void Coverage::add(std::span<const Ball> balls, const PosePath& path) {
  const std::size_t rows = static_cast<std::size_t>(height_), start = things_ * rows;
  ++things_;
  if (spans_.size() < start + rows) spans_.resize(start + rows);
  const std::span<Span> mine(spans_.data() + start, rows);
  std::fill(mine.begin(), mine.end(), Span{});
  for (const Ball& ball : balls) {
    Box before{};
    bool known = false;
    for (const Pose& pose : path.poses()) {
      Box box;
      if (!bound(pose * ball.centre, ball.radius, box)) {
        known = false;
        continue;
      }
      const Box now = box;
      if (known) {
        box = {std::min(box.left, before.left), std::max(box.right, before.right), std::min(box.top, before.top),
               std::max(box.bottom, before.bottom)};
      }
      mark(mine, box);
      before = now;
      known = true;
      if (path.still()) break;
    }
  }
}

}  // namespace onestroke
