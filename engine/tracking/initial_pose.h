#pragma once

#include "core/inline_vector.h"
#include "tracking/rod_model.h"

#include <span>
#include <vector>

namespace onestroke {

/// A cell of the rod and the gravity centre of what is seen of it, pixels.
struct CellPoint {
  int cell;
  Vec2d pixel;
};

struct PoseGuess {
  EigenPose pose;
  double rms = 0;  ///< Reprojection, pixels.
};

/// Poses from cells on both arms: OpenCV's planar solver (IPPE) gives both tilts that a plane seen in perspective
/// allows; each is then fitted to the front surface of the rings, whose gravity centres lie off the centreline. Best
/// first; empty where the points do not determine a pose.
std::vector<PoseGuess> poses_from_cells(const Intrinsics& k, const RodModel& rod, const std::vector<CellPoint>& points);

/// The same without OpenCV and without allocation, for a look at many places: both tilts under which the plane of the
/// rod, seen in weak perspective along the points' mean ray, looks as it does (DeMenthon and Davis, 1995; Ullman,
/// 1979), fitted to the front surface of the rings.
InlineVector<PoseGuess, 2> poses_in_weak_perspective(const Intrinsics& k, const RodModel& rod,
                                                     std::span<const CellPoint> points);

/// Poses from cells of one straight arm: place and direction are fitted from several tilts, the roll about the arm is
/// arbitrary. Best first.
std::vector<PoseGuess> poses_from_row(const Intrinsics& k, const RodModel& rod, const std::vector<CellPoint>& points);

/// Least squares over gravity centres from a start; with one_arm the roll about it stays. False where it diverges.
bool fit_cells(const Intrinsics& k, const RodModel& rod, std::span<const CellPoint> points, bool one_arm,
               PoseGuess& guess);

}  // namespace onestroke
