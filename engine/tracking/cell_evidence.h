#pragma once

#include "tracking/likelihood.h"
#include "tracking/rod_look.h"

#include <array>
#include <span>
#include <vector>

namespace onestroke {

/// What the pixels of a rod say for each of its cells, by their chromaticities: log(p(seen | the cell is there) /
/// p(seen | something else is)), nats. A cell seen in full tells as much as two independent samples. Borrows what it is
/// given.
class CellEvidence {
 public:
  CellEvidence(const RodRaster& raster, const RodLook& look, const Inks& inks, const Surroundings& around)
      : raster_(raster), look_(look), inks_(inks), around_(around) {}

  /// Over how much of the rod a plain thing is taken for plain: so little that a ring's own neighbourhood is, which is
  /// sharp in telling a blur, or a few rings, however many pixels they are.
  enum class Plain { close_by, some_rings };
  /// Samples a picture (linear light, of the raster's size) where the raster was last cast.
  void see(const cv::Mat& seen, Plain plain);
  /// Weighs what was seen against what the look, composed last, predicts. `spread`: standard deviation of a component
  /// of the chromaticity about what is predicted, beyond the sensor's noise; `any_ring`: the share of what shows on the
  /// rod that may be another ring than predicted.
  void weigh(float spread, float any_ring);
  /// The same of a pose that is fitted; a small part of a cell, as of a ring seen from its end, tells as much as a
  /// whole cell where it has pixels enough.
  void weigh_parts(float spread, const EigenPose& pose, const CameraBlur& blur);

  /// By cell: something else being the surroundings.
  std::span<const double> against_surroundings() const { return cells(surroundings_); }
  /// By cell: something else being the surroundings, or a plain thing of the mean colour in place of the rod, which
  /// tells rings from a finger.
  std::span<const double> against_plain() const { return cells(plain_); }
  /// What the straight arm that shows least tells against the surroundings.
  double weakest_arm() const;

 private:
  struct Sample {
    int y, x;
    std::size_t cell;
    Color seen, plain;
    float noise, around;
  };
  double pixels_in_full() const;
  void weigh(float spread, float any_ring, const std::array<double, max_cells>& share);
  std::span<const double> cells(const std::array<double, max_cells>& all) const {
    return {all.data(), static_cast<std::size_t>(raster_.rod().cell_count())};
  }

  const RodRaster& raster_;
  const RodLook& look_;
  const Inks& inks_;
  const Surroundings& around_;
  std::vector<Sample> samples_;
  std::array<double, max_cells> surroundings_{}, plain_{};
};

}  // namespace onestroke
