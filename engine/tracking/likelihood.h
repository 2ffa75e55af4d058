#pragma once

#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/rod_model.h"

#include <array>
#include <span>

namespace onestroke {

/// How often each chromaticity occurs around a marker, the marker's own pixels being few among them: what a pixel looks
/// like that does not belong to it.
class Surroundings {
 public:
  /// Counts the square in the picture that the rod could reach by turning in place.
  Surroundings(const ImageView& image, const Intrinsics& k, const RodModel& rod, const EigenPose& pose);

  /// Probability density over the triangle of (red share, green share).
  float density(const Color& chroma) const;
  /// At the rod's middle.
  double pixels_per_mm() const { return pixels_per_mm_; }

 private:
  static constexpr int bins = 32;
  std::array<float, bins * bins> density_{};
  double pixels_per_mm_ = 1;
};

/// The log of how much likelier a row of cells is as part of the rod, covered here and there, than as surroundings,
/// from each cell's own log ratio where nothing covers it. Covers come in runs, as fingers do: the forward algorithm
/// over seen and covered.
double visible_or_covered(std::span<const double> log_ratios);

/// What the picture says for poses of one rod: the sum over its visible surface of log(p(colour | ring there) /
/// p(colour | surroundings)). A stretch that may be covered costs a bounded amount, a stretch that shows what it should
/// before surroundings that look otherwise counts for it, and before surroundings of its own colour says nothing. The
/// unit of area is one cell, or what the camera resolves where a cell is smaller. All borrowed; used by one thread.
class LikelihoodMeter {
 public:
  /// Surroundings are those of `about`; poses elsewhere cannot be compared.
  LikelihoodMeter(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks,
                  const EigenPose& about);

  double operator()(const EigenPose& pose) const;
  const RodModel& rod() const { return rod_; }

 private:
  const ImageView& image_;
  const Intrinsics& k_;
  const RodModel& rod_;
  const Inks& inks_;
  Surroundings surroundings_;
};

}  // namespace onestroke
