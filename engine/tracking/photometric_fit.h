#pragma once

#include "tracking/camera_blur.h"
#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/likelihood.h"

#include <Eigen/Core>
#include <optional>

namespace onestroke {

struct PhotometricFit {
  EigenPose pose;
  Eigen::Matrix<double, 6, 6> covariance =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< Of perturbed(): rotation rad, translation mm, camera axes.
  double residual = 0;                      ///< Robust root mean square over the rod, as a share of its brightness.
  double explained = 0;                     ///< Share of the rod's visible pixels that look as predicted.
  /// As LikelihoodMeter's, of every pixel of the rod with its blur and shading: what decides between poses that look
  /// alike.
  double likelihood = 0;
  double weakest_arm = 0;  ///< What the straight arm that shows least has of it.
  double proof = 0;        ///< As the likelihood, a plain thing in place of the rod being among what else it may be.
  CameraBlur blur;         ///< As shows the rod best, pixels of the picture.
  bool valid = false;
};

struct PhotometricOptions {
  /// False: the pose is taken as it is, and only what it explains is measured.
  bool fit = true;
  /// Of the camera where it is known, pixels of the picture; else the best is found.
  std::optional<CameraBlur> blur = std::nullopt;
  /// The rod is sure to be there, and the start about as exact as ring edges out of focus leave it: a fit in full
  /// detail, and blurs that differ by depth.
  bool near = false;
};

/// Fits a pose to the whole look of the rod: the rod's picture is computed by casting rays, blurred as the camera
/// blurs, laid over the surroundings and compared with the picture pixel by pixel, in linear light; Gauss-Newton on the
/// pose with the flow of the surface points as its derivative, and on how much thicker than it is the rod looks;
/// weighted by Tukey's biweight so that covered parts drop out. Needs no ring edge to be resolved: an arm that points
/// at the camera, cells of three pixels and defocus as wide as a ring all count for what they show.
PhotometricFit fit_photometric(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod,
                               const Inks& inks, const Surroundings& surroundings, const EigenPose& start,
                               const PhotometricOptions& options = {});

}  // namespace onestroke
