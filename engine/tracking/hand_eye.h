#pragma once

#include "tracking/camera_model.h"
#include "tracking/head_calibration.h"

#include <array>
#include <vector>

namespace onestroke {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// What is sought: how the head carries its camera, and where the marker stands.
struct HandEye {
  EigenPose T_head_camera, T_world_marker;
};

/// A sight as the solvers hold it.
struct EigenSight {
  EigenPose T_world_head, T_camera_marker;
  Matrix6d covariance;
};

EigenSight to_eigen(const HeadSight& sight);

/// What a sight says against a guess: perturbation() from T_camera_marker as it follows from the guess to the measured
/// one; rad and mm, camera axes.
Vector6d hand_eye_residual(const HandEye& guess, const EigenSight& sight);

/// How the residual changes with perturbed() of T_head_camera (first six) and of T_world_marker.
Eigen::Matrix<double, 6, 12> hand_eye_jacobian(const HandEye& guess, const EigenSight& sight);

/// How far a sight is off, mm: its turn counts as what it does at the marker's distance.
double hand_eye_disagreement(const HandEye& guess, const EigenSight& sight);

/// A start for least squares: of several draws of the sights the one that the others agree with best. Throws Error
/// where none gives a solution.
HandEye start_hand_eye(const std::vector<EigenSight>& sights);

/// How well poses are known beyond what is said of them, as far as that is told by what is left over: variances of the
/// head's pose in its own axes, and of the marker's in camera axes; rad^2 and mm^2.
struct HandEyeNoise {
  enum Part { head_rotation, head_translation, marker_rotation, marker_translation, parts };
  std::array<double, parts> variance{};
  std::array<bool, parts> estimated{true, true, false, false};
};

/// What a variance of 1 of each part adds to the residual's covariance.
std::array<Matrix6d, HandEyeNoise::parts> hand_eye_noise_shapes(const HandEye& guess, const EigenSight& sight);
/// The residual's covariance.
Matrix6d hand_eye_covariance(const HandEye& guess, const EigenSight& sight, const HandEyeNoise& noise);

/// Least squares from a guess, and the noise estimated beside it from a guess of its own.
struct HandEyeFit {
  HandEye found;
  HandEyeNoise noise;
  /// Inverse covariance of both transforms, in the order of the Jacobian.
  Matrix12d information = Matrix12d::Zero();
};
HandEyeFit fit_hand_eye(const HandEyeFit& guess, const std::vector<EigenSight>& sights, int most_rounds = 100);

}  // namespace onestroke
