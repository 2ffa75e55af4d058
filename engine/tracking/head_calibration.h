#pragma once

#include "core/pose.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace onestroke {

/// Where the head was, and how its camera then saw a marker that stands still in the world. The head's axes are those
/// of a view straight ahead, vision axes; mm.
struct HeadSight {
  Pose T_world_head;
  Pose T_camera_marker;
  /// Of T_camera_marker, as MarkerObservation's; all zero where it is not known.
  std::array<double, 36> covariance{};
};

/// How far the head turned, degrees from one end to the other: about the axis with most, and about the next one at
/// right angles.
struct HeadTurn {
  double first_deg = 0, second_deg = 0;
};

/// Lengths of 0 and of 1 sight have turned by nothing.
HeadTurn head_turn(std::span<const HeadSight> sights);

/// What the pictures of a marker say against the calibration.
struct HeadResiduals {
  double rms_deg = 0, worst_deg = 0, rms_mm = 0, worst_mm = 0;
  /// Of the marker's origin in the picture; 0 without a focal length.
  double rms_px = 0, worst_px = 0;
};

/// Where the camera sits in the head, and how far that can be believed.
struct HeadCalibration {
  Pose T_head_camera, T_world_marker;
  /// 6 x 6, row-major, of T_head_camera: rotation exp(w) R (rad), then translation t + v (mm), head's axes.
  std::array<double, 36> covariance{};
  /// Of the same, from its diagonal.
  Vec3 deviation_deg{}, deviation_mm{};
  HeadTurn turn;
  HeadResiduals residuals;  ///< Of the sights that were used.
  std::size_t used = 0;
  std::size_t alike = 0;     ///< Left out because the head stood as in another one.
  std::size_t outliers = 0;  ///< Left out because they do not agree with the others.
};

/// The least that two sights differ by where both count: one of these.
inline constexpr double head_sights_apart_deg = 2, head_sights_apart_mm = 15;
/// The fewest sights that differ, and the least turn about a second axis.
inline constexpr std::size_t fewest_head_sights = 8;
inline constexpr double least_head_turn_deg = 10;

/// True where a head stands at two poses as good as alike.
bool heads_alike(const Pose& a, const Pose& b);

/// The rigid transform from a camera to the head that carries it, from a marker that stands still and a head that
/// moves: OpenCV's calibrateRobotWorldHandEye (Shah 2013) over several draws of the sights, the one that most of them
/// agree with, then least squares over both transforms. Each sight is weighed by its own covariance and by how well the
/// head's poses turn out to be known, which is estimated from the residuals (variance components by the MM algorithm of
/// Zhou, Hu, Zhou and Lange 2019). Sights that do not agree with the rest are left out.
/// focal_px: the camera's, for residuals in pixels; 0 leaves them out. Throws Error where the sights do not tell it,
/// with how to move more.
HeadCalibration calibrate_head(std::span<const HeadSight> sights, double focal_px = 0);

}  // namespace onestroke
