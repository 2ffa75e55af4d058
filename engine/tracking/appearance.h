#pragma once

#include "core/frame_record.h"
#include "core/inline_vector.h"
#include "tracking/image_view.h"
#include "tracking/inks.h"
#include "tracking/rod_model.h"

namespace onestroke {

/// How well a picture shows the rod at a pose, cell by cell.
struct Appearance {
  int in_sight = 0;     ///< Cells that the pose puts in the picture, not behind the rod itself, not end-on.
  int agrees = 0;       ///< Of these: the expected ink is there,
  int contradicts = 0;  ///< another ink is there; the rest is covered or too small to tell.
  /// Of the two straight arms that show most, how many cells agree on the lesser.
  int fewest_on_arm = 0;
  /// Smallest share of an arm's cells in sight that agree; arms with 4 or more in sight count.
  double weakest_share = 1;
  InlineVector<CellCentre, max_cells> cells;  ///< Centres of the cells that agree, on the rod's front.

  /// What speaks for the pose: a wrong ink costs four right ones; a cell that shows none, a quarter (a finger may cover
  /// it).
  double evidence() const { return agrees - 4.0 * contradicts - 0.5 * (in_sight - agrees - contradicts); }
};

Appearance assess(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const Inks& inks,
                  const EigenPose& pose);

/// Learns the inks that are not known yet from the cells of a rod at a pose: the median of each, since some cells may
/// be covered.
void complete_inks(const ImageView& image, const Intrinsics& intrinsics, const RodModel& rod, const EigenPose& pose,
                   Inks& inks);

}  // namespace onestroke
