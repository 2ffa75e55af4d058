#pragma once

#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/rod_model.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

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

/// The normal density over (red share, green share) at a difference from its mean.
float chroma_density(const Color& difference, float variance);

/// log(as_rod / otherwise) of two densities of one sample. A sample may show anything at all (a highlight, dirt): never
/// below -4 nats.
double log_ratio(float as_rod, float otherwise);

/// The log of how much likelier a row of cells is as part of the rod, covered here and there, than as surroundings,
/// from each cell's own log ratio where nothing covers it. Covers come in runs, as fingers do: the forward algorithm
/// over seen and covered.
double visible_or_covered(std::span<const double> log_ratios);
/// The probability that each cell of such a row is seen, by the forward-backward algorithm; `seen` is as long as the
/// row.
void visible_probabilities(std::span<const double> log_ratios, std::span<double> seen);

/// What the picture says for poses of one rod: the sum over its visible surface of log(p(colour | ring there) /
/// p(colour | surroundings)). A stretch that may be covered costs a bounded amount, a stretch that shows what it should
/// before surroundings that look otherwise counts for it, and before surroundings of its own colour says nothing. The
/// unit of area is one cell, or what the camera resolves where a cell is smaller. Poses are compared before the same
/// surroundings. All borrowed.
class LikelihoodMeter {
 public:
  LikelihoodMeter(const ImageView& image, const Intrinsics& k, const RodModel& rod, const Inks& inks,
                  const Surroundings& surroundings)
      : image_(image), k_(k), rod_(rod), inks_(inks), surroundings_(surroundings) {}

  double operator()(const EigenPose& pose) const;
  const RodModel& rod() const { return rod_; }

 private:
  const ImageView& image_;
  const Intrinsics& k_;
  const RodModel& rod_;
  const Inks& inks_;
  const Surroundings& surroundings_;
};

/// Of anything that has a likelihood.
constexpr auto likelier = [](const auto& a, const auto& b) { return a.likelihood > b.likelihood; };

template <typename T>
void likeliest_first(std::vector<T>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), likelier);
}

}  // namespace onestroke
