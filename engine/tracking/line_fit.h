#pragma once

#include "tracking/detection.h"
#include "tracking/ring_lines.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace onestroke {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// What is known of a motion besides a picture's edges: of the pose, by default nothing, as the inverse of its
/// covariance in the order of perturbed(), and of the velocity as standard deviations (rad/s, mm/s), by default those
/// of hands at work.
struct MotionPrior {
  Matrix6d pose_information = Matrix6d::Zero();
  std::optional<EigenPose> pose = std::nullopt;  ///< That this is about; if none, the one where a fit starts.
  double angular = 3, linear = 500;

  /// Takes in what something else tells of the pose.
  void add(const EigenPose& told, const Matrix6d& covariance);
};

struct LineFit {
  Motion motion;
  /// Of a left perturbation of the pose and of the velocity: rotation rad, translation mm, angular rad/s, linear mm/s.
  Matrix12d covariance = Matrix12d::Zero();
  int expected = 0, shown = 0;  ///< LineSet's, of the last pass.
  double supported = 0;         ///< Sum of the ring edges' robust weights.
  /// The share of each edge's lines in sight that are where they should be, by the cell after it; and how many edges
  /// are in sight.
  std::array<float, max_cells> support{};
  int edges = 0;
  double rms = 0;      ///< Of the ring edges' residuals, weighted, pixels.
  double moved = 0;    ///< Root mean square of what the last pass moved the lines by, pixels.
  bool valid = false;  ///< The system was solvable.

  /// Most of the edges that show the right inks are where the motion has them. Where not, it fits a part of the rod
  /// only.
  bool settled() const { return valid && supported > 0.7 * shown; }

  Eigen::Matrix<double, 6, 6> pose_covariance() const { return covariance.topLeftCorner<6, 6>(); }
};

/// Gives a detection the velocity that was fitted with its pose; where the shutter does not roll none was.
void take_velocity(const TimedView& view, const LineFit& fit, Detection& detection);

/// What a fit works in.
struct LineMemory {
  /// The lines of one ring edge, which follow one another, or those of the outline beside one cell.
  struct Group {
    std::size_t first, last;
    bool ring;
    double effect = 0;  ///< By which all of them are off alike, pixels.
    double weight = 1;
  };
  std::vector<Group> groups;
  std::vector<double> rows, residuals, scratch;
};

/// Fits a motion to the rod's edges in a picture. Keeps its memory between pictures; used by one thread at a time.
class LineFitter {
 public:
  /// Passes over the picture, one after another. Where the shutter rolls the velocity is fitted with the pose, from and
  /// about the start's; elsewhere it stays as it is.
  LineFit fit(const TimedView& view, const RodModel& rod, const Inks& inks, const Motion& start,
              const MotionPrior& prior, std::span<const LineOptions> passes);

 private:
  LineSet set_;
  LineMemory memory_;
};

}  // namespace onestroke
