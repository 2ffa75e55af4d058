#include "camera/lens.h"
#include "camera/row_painter.h"

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

constexpr int most_time_samples = 16;

double pixels_between(const Intrinsics& k, Vec3 a, Vec3 b) {
  if (a.z < 1 || b.z < 1) return 0;
  const Point2 p = distort(k, {a.x / a.z, a.y / a.z}), q = distort(k, {b.x / b.z, b.y / b.z});
  return std::hypot(p.x - q.x, p.y - q.y);
}

double travel(const Intrinsics& k, const PosePath& path, Vec3 point) {
  double sum = 0;
  for (std::size_t i = 1; i < path.poses().size(); ++i) {
    sum += pixels_between(k, path.poses()[i - 1] * point, path.poses()[i] * point);
  }
  return sum;
}

/// The longest way that anything goes in the picture during the whole span, in pixels.
double longest_travel(const SyntheticFrame& frame) {
  double most = 0;
  for (const SyntheticMarker& m : frame.markers) {
    if (m.T_camera_marker.still()) continue;
    for (const Rod::Group& g : m.rod->groups()) {
      for (const Ball* ball : {&g.cover.front(), &g.cover.back()}) {
        most = std::max(most, travel(frame.intrinsics, m.T_camera_marker, ball->centre));
      }
    }
  }
  for (const SyntheticFinger& f : frame.fingers) {
    if (!f.T_camera_finger.still()) most = std::max(most, travel(frame.intrinsics, f.T_camera_finger, Vec3{}));
  }
  const auto& head = frame.T_world_camera.poses();
  double turn = 0;
  for (std::size_t i = 1; i < head.size(); ++i) turn += angle_between(head[i - 1].rotation, head[i].rotation);
  return frame.room ? std::max(most, turn * frame.intrinsics.fx) : most;
}

}  // namespace

void FramePlan::make(const SyntheticFrame& frame) {
  const Duration span = frame.effects.exposure + frame.effects.readout;
  const double share = span.ns > 0 ? frame.effects.exposure.seconds() / span.seconds() : 0;
  const double pixels = longest_travel(frame) * share;
  time_samples = pixels < 0.2 ? 1 : std::clamp(static_cast<int>(std::ceil(pixels)), 3, most_time_samples);

  coverage.reset(frame.intrinsics, frame.width, frame.height);
  for (const SyntheticMarker& m : frame.markers) {
    for (const Rod::Group& g : m.rod->groups()) coverage.add(g.cover, m.T_camera_marker);
  }
  for (const SyntheticFinger& f : frame.fingers) {
    constexpr int most_balls = 32;
    std::array<Ball, most_balls> balls;
    const int n = std::clamp(static_cast<int>(std::ceil(f.length / f.radius)) + 1, 2, most_balls);
    const double step = f.length / (n - 1);
    for (int i = 0; i < n; ++i) balls[static_cast<std::size_t>(i)] = {{0, step * i, 0}, std::hypot(step / 2, f.radius)};
    coverage.add(std::span(balls).first(static_cast<std::size_t>(n)), f.T_camera_finger);
  }
}

double FramePlan::moment(const SyntheticFrame& frame, int row, int k) const {
  const double length = frame.effects.exposure.seconds(), readout = frame.effects.readout.seconds();
  if (length + readout <= 0) return 0.5;
  const double down = frame.height > 1 ? static_cast<double>(row) / (frame.height - 1) : 0.5;
  return (down * readout + (k + 0.5) / time_samples * length) / (length + readout);
}

}  // namespace onestroke
