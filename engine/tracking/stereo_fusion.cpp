#include "tracking/stereo_fusion.h"

#include "core/pose_history.h"
#include "tracking/pose_fusion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

// Chi squared with 6 degrees of freedom is larger once in a thousand times.
constexpr double expected_disagreement = 22.46;
// A tracker errs by several times what its covariance tells where an arm points at its camera, and not by more than
// this where it has the right idea of the marker at all.
constexpr double most_disagreement = 1000;
constexpr double degrees_of_freedom = 6;
// What a velocity may be off by: a share of itself, as it lags behind, and what it is never surer than.
constexpr double velocity_share = 0.2, least_angular = 0.05, least_linear = 10;  // rad/s, mm/s

Matrix6d covariance_of(const MarkerObservation& o) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(o.covariance.data());
}

void set_covariance(const Matrix6d& covariance, MarkerObservation& o) {
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(o.covariance.data()) = covariance;
}

/// The logarithm of how much room the covariance leaves.
double vagueness(const PoseMeasurement& m) {
  return std::log(m.covariance.determinant());
}

/// From the second camera's record to the first's axes and time.
class Passage {
 public:
  Passage(const FrameRecord& from, const FrameRecord& to)
      : T_to_from_(inverse(to.T_world_camera) * from.T_world_camera), later_(to.time - from.time) {}

  PoseMeasurement pose_of(const MarkerObservation& o) const {
    PoseMeasurement m{T_to_from_ * advance(o.T_camera_marker, o.velocity, later_),
                      turned(covariance_of(o), T_to_from_.rotation)};
    const double seconds = later_.seconds();
    const double angular = (velocity_share * norm(o.velocity.angular) + least_angular) * seconds;
    const double linear = (velocity_share * norm(o.velocity.linear) + least_linear) * seconds;
    m.covariance.diagonal().head<3>().array() += angular * angular;
    m.covariance.diagonal().tail<3>().array() += linear * linear;
    return m;
  }
  Velocity velocity_of(const MarkerObservation& o) const {
    return {rotate(T_to_from_.rotation, o.velocity.angular), rotate(T_to_from_.rotation, o.velocity.linear)};
  }

 private:
  Pose T_to_from_;
  Duration later_;
};

std::uint64_t cells_of(const MarkerObservation& o) {
  std::uint64_t bits = 0;
  for (int i = 0; i < o.cells_seen; ++i) {
    const int index = o.cells[static_cast<std::size_t>(i)].index;
    if (index >= 0 && index < max_cells_per_marker) bits |= std::uint64_t{1} << index;
  }
  return bits;
}

Vec3 mean(Vec3 a, double weight_a, Vec3 b, double weight_b) {
  return (weight_a * a + weight_b * b) / (weight_a + weight_b);
}

/// A record says nothing of how sure a velocity is, so each counts as much as its pose.
Velocity mean(const Velocity& a, const PoseMeasurement& pose_a, const Velocity& b, const PoseMeasurement& pose_b) {
  const auto weight = [](const PoseMeasurement& m, int block) {
    return 1 / m.covariance.block<3, 3>(3 * block, 3 * block).trace();
  };
  return {mean(a.angular, weight(pose_a, 0), b.angular, weight(pose_b, 0)),
          mean(a.linear, weight(pose_a, 1), b.linear, weight(pose_b, 1))};
}

void set(const PoseMeasurement& pose, const Velocity& velocity, MarkerObservation& o) {
  o.T_camera_marker = pose.pose;
  set_covariance(pose.covariance, o);
  o.velocity = velocity;
}

/// No farther from either than they are from each other, or not by much.
bool is_between(const Pose& p, const Pose& a, const Pose& b) {
  constexpr double times = 2, least_turn = 1e-3, least_shift = 0.1;  // rad, mm
  const auto turn = [](const Pose& from, const Pose& to) { return angle_between(from.rotation, to.rotation); };
  const auto shift = [](const Pose& from, const Pose& to) { return norm(from.translation - to.translation); };
  return std::max(turn(p, a), turn(p, b)) < times * turn(a, b) + least_turn &&
         std::max(shift(p, a), shift(p, b)) < times * shift(a, b) + least_shift;
}

void fuse(const MarkerObservation& second, const Passage& passage, MarkerObservation& o) {
  if (second.state == MarkerState::measured) o.second_cells = cells_of(second);
  if (o.state < second.state) return;
  const PoseMeasurement other = passage.pose_of(second);
  const Velocity velocity = passage.velocity_of(second);
  const PoseMeasurement own{o.T_camera_marker, covariance_of(o)};
  if (second.state < o.state) {
    o.state = second.state;
    set(other, velocity, o);
    return;
  }
  const double apart = o.state == MarkerState::measured ? disagreement(own, other) : most_disagreement;
  if (apart < most_disagreement) {
    PoseMeasurement both = fused(own, other);
    if (apart > expected_disagreement) both.covariance *= apart / degrees_of_freedom;
    if (is_between(both.pose, own.pose, other.pose)) return set(both, mean(o.velocity, own, velocity, other), o);
  }
  if (vagueness(other) < vagueness(own)) set(other, velocity, o);
}

void add(const MarkerObservation& second, const Passage& passage, FrameRecord& record) {
  if (record.marker_count == max_markers_per_frame) return;
  MarkerObservation& o = record.markers[static_cast<std::size_t>(record.marker_count++)];
  o.id = second.id;
  o.name = second.name;
  o.state = second.state;
  o.cells_seen = 0;
  o.second_cells = second.state == MarkerState::measured ? cells_of(second) : 0;
  set(passage.pose_of(second), passage.velocity_of(second), o);
}

}  // namespace

void fuse_second(const FrameRecord& second, FrameRecord& record) {
  const Passage passage(second, record);
  const auto first_ones = std::span(record.markers).first(static_cast<std::size_t>(record.marker_count));
  for (const MarkerObservation& o : second.seen()) {
    const auto own = std::ranges::find(first_ones, o.id, &MarkerObservation::id);
    if (own == first_ones.end())
      add(o, passage, record);
    else
      fuse(o, passage, *own);
  }
}

}  // namespace onestroke
