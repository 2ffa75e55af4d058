#include "tracking/rolling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace onestroke {

// What a point's velocity on its circle or screw lacks of the way it goes in `seconds`, by the second and third order;
// the fourth is below a hundredth of a millimetre within a picture.
Vec3d Motion::bend(const Vec3d& velocity, double seconds) const {
  const Vec3d second = angular.cross(velocity);
  return second / 2 + seconds / 6 * angular.cross(second);
}

EigenPose Motion::at(double seconds) const {
  Eigen::Matrix<double, 6, 1> delta;
  delta << seconds * angular, seconds * (linear + seconds * bend(linear, seconds));
  return perturbed(pose, delta);
}

bool project_rolling(const Intrinsics& k, const RowClock& clock, const Motion& motion, const Vec3d& point,
                     Vec2d& pixel) {
  if (!project(k, point, pixel)) return false;
  const Vec3d velocity = motion.velocity_of(point);
  // The row's time as a function of the time at which the point is projected is nearly a line: secants meet it at once.
  double t = 0, row_time = clock.at(pixel.y()), slope = 0;
  for (int round = 0; round < 3; ++round) {
    const double next = t + (row_time - t) / (1 - slope);
    if (!project(k, point + next * (velocity + next * motion.bend(velocity, next)), pixel)) return false;
    const double then = clock.at(pixel.y());
    if (std::abs(next - t) > 1e-9) slope = std::clamp((then - row_time) / (next - t), -0.5, 0.5);
    t = next;
    row_time = then;
  }
  return true;
}

}  // namespace onestroke
