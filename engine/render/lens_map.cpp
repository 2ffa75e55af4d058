#include "render/lens_map.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

std::array<double, 2> bent(const Intrinsics& k, double x, double y) {
  const auto& [k1, k2, p1, p2, k3] = k.distortion;
  const double r2 = x * x + y * y, radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

std::array<double, 2> bent_to_limit(const Intrinsics& k, double x, double y, double limit) {
  const double r2 = x * x + y * y;
  if (r2 <= limit) return bent(k, x, y);
  const double scale = std::sqrt(limit / r2);
  const auto [at_x, at_y] = bent(k, scale * x, scale * y);
  return {at_x + (1 - scale) * x, at_y + (1 - scale) * y};
}

}  // namespace

double distortion_limit(const Intrinsics& intrinsics) {
  const auto& d = intrinsics.distortion;
  constexpr double farthest = 100;  // r = 10, 84 degrees off the axis
  constexpr int steps = 2000;
  for (int i = 1; i <= steps; ++i) {
    const double r2 = farthest * i / steps;
    const double slope = 1 + r2 * (3 * d[0] + r2 * (5 * d[1] + r2 * 7 * d[4]));
    if (slope <= 0) return farthest * (i - 1) / steps;
  }
  return farthest;
}

std::array<double, 2> through_lens(const Intrinsics& k, double x, double y) {
  if (k.distorted()) {
    const auto [at_x, at_y] = bent_to_limit(k, x, y, distortion_limit(k));
    x = at_x;
    y = at_y;
  }
  return {k.fx * x + k.cx, k.fy * y + k.cy};
}

std::array<double, 2> without_lens(const Intrinsics& k, double u, double v) {
  const double wanted_x = (u - k.cx) / k.fx, wanted_y = (v - k.cy) / k.fy;
  if (!k.distorted()) return {wanted_x, wanted_y};
  const double limit = distortion_limit(k);
  double x = wanted_x, y = wanted_y;
  // Half steps settle where whole ones would swing about a strong lens's edge.
  constexpr int steps = 100;
  for (int i = 0; i < steps; ++i) {
    const auto [seen_x, seen_y] = bent_to_limit(k, x, y, limit);
    x += 0.5 * (wanted_x - seen_x);
    y += 0.5 * (wanted_y - seen_y);
  }
  return {x, y};
}

PlaneBounds picture_bounds(const Intrinsics& k, int width, int height, double margin) {
  constexpr int steps = 16;
  const double more = margin * height;
  PlaneBounds bounds{1e9, 1e9, -1e9, -1e9};
  const auto take = [&](double u, double v) {
    const auto [x, y] = without_lens(k, u, v);
    bounds = {std::min(bounds.left, x), std::min(bounds.top, y), std::max(bounds.right, x), std::max(bounds.bottom, y)};
  };
  for (int i = 0; i <= steps; ++i) {
    const double u = -more + (width + 2 * more) * i / steps, v = -more + (height + 2 * more) * i / steps;
    take(u, -more);
    take(u, height + more);
    take(-more, v);
    take(width + more, v);
  }
  return bounds;
}

PlaneBounds inner_bounds(const Intrinsics& k, int width, int height) {
  constexpr int steps = 64;
  PlaneBounds bounds{-1e9, -1e9, 1e9, 1e9};
  for (int i = 0; i <= steps; ++i) {
    const double u = static_cast<double>(width) * i / steps, v = static_cast<double>(height) * i / steps;
    bounds = {std::max(bounds.left, without_lens(k, 0, v)[0]), std::max(bounds.top, without_lens(k, u, 0)[1]),
              std::min(bounds.right, without_lens(k, width, v)[0]),
              std::min(bounds.bottom, without_lens(k, u, height)[1])};
  }
  bounds.right = std::max(bounds.right, bounds.left);
  bounds.bottom = std::max(bounds.bottom, bounds.top);
  return bounds;
}

std::array<float, 4> LensMap::placement() const {
  // From the first sample's middle to the last's, so that the bounds themselves are sampled.
  const double scale_x = (width - 1) / (bounds.right - bounds.left) / width;
  const double scale_y = (height - 1) / (bounds.bottom - bounds.top) / height;
  return {static_cast<float>(scale_x), static_cast<float>(scale_y),
          static_cast<float>(0.5 / width - bounds.left * scale_x),
          static_cast<float>(0.5 / height - bounds.top * scale_y)};
}

LensMap make_lens_map(const Intrinsics& k, int picture_width, int picture_height, const PlaneBounds& bounds) {
  LensMap map{.bounds = bounds, .shifts = {}};
  map.shifts.reserve(std::size_t{2} * LensMap::width * LensMap::height);
  const double limit = distortion_limit(k);
  for (int row = 0; row < LensMap::height; ++row)
    for (int column = 0; column < LensMap::width; ++column) {
      const double x = bounds.left + (bounds.right - bounds.left) * column / (LensMap::width - 1);
      const double y = bounds.top + (bounds.bottom - bounds.top) * row / (LensMap::height - 1);
      const auto [at_x, at_y] = bent_to_limit(k, x, y, limit);
      map.shifts.push_back(static_cast<float>((at_x - x) * k.fx / picture_width));
      map.shifts.push_back(static_cast<float>((at_y - y) * k.fy / picture_height));
    }
  return map;
}

}  // namespace onestroke
