#include "tracking/rolling.h"

#include <Eigen/Geometry>
#include <cmath>

namespace onestroke {

EigenPose Motion::at(double seconds) const {
  Eigen::Matrix<double, 6, 1> delta;
  // The origin's acceleration on its circle or screw is angular x linear; what comes after is below a hundredth of a
  // millimetre within a picture.
  delta << seconds * angular, seconds * linear + 0.5 * seconds * seconds * angular.cross(linear);
  return perturbed(pose, delta);
}

bool project(const Intrinsics& k, const RowClock& clock, const Motion& motion, const Vec3d& point, Vec2d& pixel) {
  if (!project(k, point, pixel)) return false;
  if (!clock.rolls()) return true;
  const Vec3d velocity = motion.velocity_of(point), bend = 0.5 * motion.angular.cross(velocity);
  // Rows pass many times faster than the marker: each round leaves a tenth of the error at most.
  for (int round = 0; round < 3; ++round) {
    const double t = clock.at(pixel.y());
    if (!project(k, point + t * (velocity + t * bend), pixel)) return false;
  }
  return true;
}

}  // namespace onestroke
