#include "tracking/roll_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace onestroke {
namespace {

// 3 degrees move the far tip of a 72 mm arm by little more than its radius.
constexpr int steps = 120;

std::vector<RollCandidate> turn_about(const LikelihoodMeter& meter, const EigenPose& pose, int cell) {
  std::vector<RollCandidate> ring;
  for (int i = 0; i < steps; ++i) {
    const EigenPose turned = roll_about(meter.rod(), pose, cell, 2 * std::numbers::pi * i / steps);
    ring.push_back({turned, meter(turned)});
  }
  return ring;
}

bool is_peak(const std::vector<RollCandidate>& ring, int i) {
  const auto at = [&](int k) { return ring[static_cast<std::size_t>((k + steps) % steps)].likelihood; };
  return at(i) >= at(i - 1) && at(i) > at(i + 1);
}

}  // namespace

std::vector<RollCandidate> search_roll(const LikelihoodMeter& meter, const EigenPose& pose, int cell_on_arm,
                                       int count) {
  const std::vector<RollCandidate> ring = turn_about(meter, pose, cell_on_arm);
  std::vector<RollCandidate> peaks;
  for (int i = 0; i < steps; ++i)
    if (is_peak(ring, i)) peaks.push_back(ring[static_cast<std::size_t>(i)]);
  likeliest_first(peaks);
  if (static_cast<int>(peaks.size()) > count) peaks.resize(static_cast<std::size_t>(count));
  return peaks;
}

double roll_margin(const LikelihoodMeter& meter, const EigenPose& pose) {
  // Closer than this a peak is the pose's own.
  constexpr int own = 5;
  double margin = 1e9;
  for (const int cell : arm_middles(meter.rod())) {
    const std::vector<RollCandidate> ring = turn_about(meter, pose, cell);
    double here = ring.front().likelihood;
    for (int i = 1; i <= own; ++i)
      here = std::max(
          {here, ring[static_cast<std::size_t>(i)].likelihood, ring[static_cast<std::size_t>(steps - i)].likelihood});
    for (int i = own + 1; i < steps - own; ++i)
      if (is_peak(ring, i)) margin = std::min(margin, here - ring[static_cast<std::size_t>(i)].likelihood);
  }
  return margin;
}

EigenPose mirrored(const RodModel& rod, const EigenPose& pose) {
  const Vec3d middle = pose * rod.centre(), view = middle.normalized();
  EigenPose other;
  // Two reflections make a rotation: one in the picture's plane, one in the rod's own.
  const Vec3d& normal = rod.plane_normal();
  other.R = (Mat3d::Identity() - 2 * view * view.transpose()) * pose.R *
            (Mat3d::Identity() - 2 * normal * normal.transpose());
  other.t = middle - other.R * rod.centre();
  return other;
}

std::vector<int> arm_middles(const RodModel& rod) {
  std::vector<int> middles;
  for (int first = 0, last = 0; first < rod.cell_count(); first = last) {
    while (last < rod.cell_count() && rod.arm_of(last) == rod.arm_of(first)) ++last;
    if (rod.arm_of(first) >= 0) middles.push_back((first + last) / 2);
  }
  return middles;
}

RollCandidate climb(const LikelihoodMeter& meter, const EigenPose& start) {
  const RodModel& rod = meter.rod();
  const std::vector<int> cells = arm_middles(rod);
  RollCandidate best{start, meter(start)};
  for (const double step : {0.07, 0.035, 0.0175})
    for (int moves = 0; moves < 6; ++moves) {
      const RollCandidate from = best;
      const auto consider = [&](const EigenPose& pose) {
        const double likelihood = meter(pose);
        if (likelihood > best.likelihood) best = {pose, likelihood};
      };
      for (const int cell : cells)
        for (const double angle : {-step, step}) {
          consider(roll_about(rod, from.pose, cell, angle));
          consider(tilt_arm(rod, from.pose, cell, angle));
        }
      if (best.likelihood <= from.likelihood) break;
    }
  return best;
}

EigenPose roll_about(const RodModel& rod, const EigenPose& pose, int cell_on_arm, double angle) {
  const RodModel::Section& section = rod.middle(cell_on_arm);
  const Mat3d roll = Eigen::AngleAxisd(angle, section.tangent).toRotationMatrix();
  EigenPose turned;
  turned.R = pose.R * roll;
  turned.t = pose.t + pose.R * (section.centre - roll * section.centre);
  return turned;
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
