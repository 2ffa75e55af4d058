#pragma once

#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/rod_model.h"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace onestroke {

struct RefineOptions {
  int max_iterations = 12;
  /// Standard deviations of one edge measurement, pixels.
  double ring_sigma = 0.15, outline_sigma = 0.5;
  /// Only these cells are used.
  int first_cell = 0, last_cell = max_cells - 1;
  /// The cells used lie on one straight arm: the roll about it stays as it is.
  bool one_arm = false;
};

struct Refinement {
  EigenPose pose;
  Matrix6d covariance = Matrix6d::Zero();  ///< Of perturbed(): rotation rad, translation mm, camera axes.
  int expected = 0;                        ///< Ring-edge points that should be seen.
  double supported = 0;                    ///< Sum of their robust weights.
  double rms = 0;                          ///< Of the ring edges' residuals, weighted, pixels.
  std::array<float, max_cells> support{};  ///< As supported, by the cell after the edge.
  bool valid = false;                      ///< The system was solvable.
};

/// Least squares over the ring geometry: ring edges (arcs of the rings' ellipses, measured along the rod's generator
/// lines where the colour steps from ink to ink) and the rod's outline, each predicted from the pose, found in the
/// picture to sub-pixel, and weighted by Tukey's biweight so that covered parts drop out. Levenberg-Marquardt, edges
/// measured anew at every step.
Refinement refine(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                  const EigenPose& start, const RefineOptions& options = {});

}  // namespace onestroke
