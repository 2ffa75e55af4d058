#pragma once

#include "tracking/image_view.h"
#include "tracking/pixel_run.h"
#include "tracking/rod_caster.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <vector>

namespace onestroke {

/// The part of a picture that a rod may move in, and which of its rings each pixel there would show. All planes are of
/// one size, in working pixels: the picture itself, or reduced until the rod is about 14 pixels thick. Borrows what it
/// is given; used by one thread.
class RodRaster {
 public:
  RodRaster(const ImageView& image, const Intrinsics& k, const RodModel& rod)
      : image_(image), k_(k), rod_(rod), caster_(rod) {}

  /// How much of a picture a rod's working pixels keep: a thick rod may be reduced, and less room is left around it; or
  /// all, and room for the widest defocus.
  enum class Detail { enough, full };
  /// Cuts the part around a pose out of the picture; false where none of it is to be seen.
  bool crop(const EigenPose& about, Detail detail);
  /// Casts the rod at a pose near that of crop(); surface points are given to `reach` working pixels beyond its
  /// outline. False where hardly anything of it lies in the part.
  bool cast(const EigenPose& pose, double reach);

  /// A pixel, and its place in planes of one value a pixel.
  struct Spot {
    int y, x;
    std::size_t i;
  };
  /// The pixels that the rod may come to cover or touch; the rest is surroundings.
  const std::vector<Spot>& spots() const { return spots_; }
  /// The same, as runs along the rows.
  const std::vector<PixelRun>& runs() const { return runs_; }
  /// The picture as coded, 0..255, and in linear light, 0..1: CV_32FC3.
  const cv::Mat& coded() const { return coded_; }
  const cv::Mat& linear() const { return linear_; }
  /// By cast(), the share of each pixel that shows ink 0, 1, 2, and their sum: CV_32FC4.
  const cv::Mat& mix() const { return mix_; }
  /// By cast(), whether a pixel shows more rod than anything else.
  bool on_rod(int y, int x) const { return mix_.at<cv::Vec4f>(y, x)[3] > 0.5F; }
  /// By cast(), whether a pixel is within reach of the rod, and the cell and the point (camera axes, mm) that it shows
  /// or that are nearest to it.
  bool within_reach(std::size_t i) const { return near_[i]; }
  int cell(std::size_t i) const { return cell_[i]; }
  const Vec3d& point(std::size_t i) const { return points_[i]; }

  /// Pixels of the picture that a working pixel is wide.
  int factor() const { return factor_; }
  Detail detail() const { return detail_; }
  const RodModel& rod() const { return rod_; }
  const Intrinsics& intrinsics() const { return k_; }

 private:
  void reduce(int width, int height);
  void find_spots(const EigenPose& about, int room);
  void cast_edges(const Vec3d& eye, const Mat3d& back);
  std::uint8_t cell_at(double s) const;

  const ImageView& image_;
  const Intrinsics& k_;
  const RodModel& rod_;
  RodCaster caster_;
  Detail detail_ = Detail::enough;
  int factor_ = 1, left_ = 0, top_ = 0;
  cv::Mat coded_, linear_, mix_;
  std::vector<Spot> spots_;
  std::vector<PixelRun> runs_;
  std::vector<Vec3d> rays_, points_;
  std::vector<std::uint8_t> near_, cell_, shown_;
};

}  // namespace onestroke
