#include "camera/pose_path.h"

#include <algorithm>

namespace onestroke {
namespace {

bool same(const Pose& a, const Pose& b) {
  return a.translation == b.translation && a.rotation.w == b.rotation.w && a.rotation.x == b.rotation.x &&
         a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z;
}

}  // namespace

PosePath::PosePath(const std::array<Pose, knots>& poses) : poses_(poses) {
  still_ = std::all_of(poses.begin(), poses.end(), [&](const Pose& p) { return same(p, poses[0]); });
}

Pose PosePath::at(double u) const {
  if (still_) return middle();
  const double k = std::clamp(u, 0.0, 1.0) * (knots - 1);
  const int i = std::min(static_cast<int>(k), knots - 2);
  return interpolate(poses_[static_cast<std::size_t>(i)], poses_[static_cast<std::size_t>(i + 1)], k - i);
}

}  // namespace onestroke
