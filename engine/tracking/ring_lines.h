#pragma once

#include "tracking/inks.h"
#include "tracking/rod_model.h"
#include "tracking/rolling.h"

#include <array>
#include <vector>

namespace onestroke {

/// An ink may take more room in the picture than it has on the rod, as it may be the brighter one, and so may the rod:
/// pixels by which each of three pairs of inks and each side of the outline of the first arm and of the others is off.
/// A side that runs along the pixels' rows is off alike all along.
inline constexpr int growths = 7, outline_growth = 3;

/// Where an edge of the rod was found in the picture, against where a motion predicts it.
struct LineMeasurement {
  Eigen::Matrix<double, 6, 1> by_pose;  ///< Derivative of the offset by perturbed()'s delta of the pose.
  double seconds;                       ///< When the row that it falls on was exposed, RowClock's.
  double offset;                        ///< Pixels, along the edge's normal in the picture.
  double sigma;                         ///< Standard deviation that the picture's noise and grain give it, pixels.
  int cell;                             ///< The cell after the ring edge, or beside the outline.
  int growth;                           ///< Which growth moves it too: that of a pair of inks, or the outline's.
  double by_growth;                     ///< Derivative of the offset by it.

  bool ring() const { return growth < outline_growth; }
};

struct LineSet {
  std::vector<LineMeasurement> lines;
  int expected = 0;                          ///< Ring-edge points that the pose puts in sight.
  std::array<int, max_cells> expected_at{};  ///< The same by the cell after the edge.
  int shown = 0;  ///< Of these, those on both sides of which the picture shows the right inks.
};

struct LineOptions {
  /// How far from the prediction an edge is looked for, pixels; never beyond the middle of the cells beside it.
  double reach = 4;
  /// Between lines across the rod, pixels; and how many there are at most.
  double spacing = 1.8;
  int max_lines = 40;
  /// Between places along the rod where its outline is measured, pixels.
  double outline_spacing = 2.5;
  /// Every which ring edge is measured, and the outline beside every which cell.
  int stride = 1, outline_stride = 1;
  /// How often the lines are weighed by how well they agree.
  int reweightings = 3;
};

/// Measures the rod's ring edges along generator lines of its surface, and its outline. A line's colours pass from one
/// cell's to the next one's, in linear light, as the integral of the camera's blur; the offset is the least-squares fit
/// of a blurred step as wide as `reach`, put right for how steep the edge is: unbiased where it is small, whatever the
/// blur, if that is symmetrical. Each
/// point is predicted for the time at which its row is exposed.
void measure_lines(const TimedView& view, const RodModel& rod, const Inks& inks, const Motion& motion,
                   const LineOptions& options, LineSet& set);

}  // namespace onestroke
