#pragma once

#include "tracking/camera_blur.h"
#include "tracking/disc_blur.h"
#include "tracking/rod_raster.h"

#include <array>

namespace onestroke {

/// The chromaticity of linear light (red, green, blue, 0..1) as cameras code it.
Color chroma_of(const cv::Vec3f& linear);

/// Gaussian blur, edges repeated; `sigma` in pixels of the plane.
void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma);

/// The picture that the camera should have taken of a rod that stands where a RodRaster has it: its inks in this light
/// by least squares, its shading and surroundings by local means of the picture itself, blurred as the camera blurs: a
/// little as by a Gaussian, more as by a disc of defocus.
class RodLook {
 public:
  /// Borrowed; cast() is called before each compose().
  explicit RodLook(const RodRaster& raster) : raster_(raster) {}

  /// The raster's picture in linear light, blurred beyond the camera by `extra_blur` working pixels. Borrowed.
  void see(const cv::Mat& seen, double extra_blur);
  /// `weight`: how far each pixel is trusted to show the rod, CV_32F; blur in working pixels. False where the inks
  /// cannot be told.
  bool compose(const cv::Mat& weight, const CameraBlur& camera_blur);

  /// Linear light, CV_32FC3; as seen, away from the rod's spots.
  const cv::Mat& picture() const { return picture_; }
  /// What each ink was found to look like, linear light.
  const std::array<cv::Vec3f, 3>& inks() const { return inks_; }
  /// Whether the picture is known at a pixel: surroundings and shading have something to be taken from.
  bool known(int y, int x) const { return known_.at<std::uint8_t>(y, x) != 0; }

 private:
  // Both return the widest blur of the rod.
  double blur_as_camera(const CameraBlur& camera_blur);
  double blur_by_depth(const CameraBlur& camera_blur);
  void blur_evenly(const cv::Mat& mix, double camera_blur, cv::Mat& to);
  bool find_inks();
  void find_surroundings(double blur);
  void find_veils();
  void find_shading();
  cv::Vec3f behind(int y, int x) const;
  cv::Vec3f paint(int y, int x) const;
  std::size_t arm_at(int y, int x) const;

  // Arms told apart, and the bends.
  static constexpr std::size_t arms = 8;

  const RodRaster& raster_;
  DiscBlur disc_;
  double extra_blur_ = 0;
  cv::Mat seen_, weight_, spread_, layer_, mix_, uncovered_, outside_, rod_light_, ratio_, shading_, picture_, known_;
  std::array<cv::Vec3f, 3> inks_;
  std::array<float, arms> veil_{};  // By arm, the bends first.
  cv::Vec3f white_;
};

}  // namespace onestroke
