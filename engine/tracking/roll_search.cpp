#include "tracking/roll_search.h"

#include "tracking/appearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace onestroke {

std::vector<RollCandidate> search_roll(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod,
                                       const Inks& inks, const EigenPose& pose, int cell_on_arm, int count) {
  // 3 degrees move the far tip of a 72 mm arm by little more than its radius.
  constexpr int steps = 120;
  const RodModel::Section& section = rod.middle(cell_on_arm);
  std::vector<RollCandidate> ring;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * std::numbers::pi * i / steps;
    EigenPose turned;
    const Mat3d roll = Eigen::AngleAxisd(angle, section.tangent).toRotationMatrix();
    turned.R = pose.R * roll;
    turned.t = pose.t + pose.R * (section.centre - roll * section.centre);
    ring.push_back({turned, assess(image, intrinsics, rod, inks, turned).evidence()});
  }
  std::vector<RollCandidate> peaks;
  for (int i = 0; i < steps; ++i) {
    const auto at = [&](int k) { return ring[static_cast<std::size_t>((k + steps) % steps)].evidence; };
    if (at(i) >= at(i - 1) && at(i) > at(i + 1)) peaks.push_back(ring[static_cast<std::size_t>(i)]);
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const RollCandidate& a, const RollCandidate& b) { return a.evidence > b.evidence; });
  if (static_cast<int>(peaks.size()) > count) peaks.resize(static_cast<std::size_t>(count));
  return peaks;
}

EigenPose tilt_arm(const RodModel& rod, const EigenPose& pose, int cell_on_arm, double angle) {
  const RodModel::Section& section = rod.middle(cell_on_arm);
  const Vec3d middle = pose * section.centre, arm = pose.R * section.tangent;
  const Vec3d view = middle.normalized(), hinge = arm.cross(view);
  if (hinge.norm() < 1e-3) return pose;
  const Mat3d turn = Eigen::AngleAxisd(angle, hinge.normalized()).toRotationMatrix();
  // Seen from the side an arm looks longer: the distance makes up for it.
  const double before = hinge.norm(), after = (turn * arm).cross(view).norm();
  EigenPose tilted;
  tilted.R = turn * pose.R;
  tilted.t = middle * (after / before) - tilted.R * section.centre;
  return tilted;
}

}  // namespace onestroke
