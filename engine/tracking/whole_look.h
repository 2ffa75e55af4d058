#pragma once

#include "tracking/detection.h"
#include "tracking/levels.h"
#include "tracking/look_fits.h"

#include <functional>
#include <vector>

namespace onestroke {

/// Judges poses by the whole look of the rod (fit_photometric), where its ring edges prove nothing or too much: an arm
/// that points at the camera, defocus as wide as a ring, cells of a few pixels, an arm behind fingers. Borrows all that
/// it is given.
class WholeLook {
 public:
  WholeLook(const Levels& levels, const Intrinsics& intrinsics, const std::vector<RodModel>& rods)
      : levels_(levels), intrinsics_(intrinsics), rods_(rods) {}

  /// Fits the likeliest of a marker's candidates (one at least, best first), `max_fits` of them, then looks beside
  /// the best; what is likely but not sure is fitted again in full detail with its rivals, unless it is `hopeless` by
  /// what else is known, as that takes seconds. False where it is not likely enough, or another way of holding the rod
  /// is nearly as likely; the detection then tells what was found nevertheless, its likelihood being 0 where that is
  /// nothing.
  bool prove(const std::vector<PoseCandidate>& candidates, std::size_t max_fits,
             const std::function<bool(const Detection&)>& hopeless, Detection& detection) const;

  /// Ring edges may prove a marker in two places, as the two tilts of a plane seen from afar: keeps the likelier.
  void settle_rivals(std::vector<Detection>& proven) const;

  /// Where cells are few pixels long or blurred into one another their edges are found with a bias, and where few are
  /// found or loosely, the other tilt may be the right one: fits these again.
  void polish(Detection& detection) const;

  /// A detection whose ring edges scatter, once more by the whole look. False where that leaves it as it is.
  bool settle(Detection& detection) const;

 private:
  LookFits fits_of(int marker, const EigenPose& about) const;
  static void fit_likeliest(LookFits& fits, const std::vector<PoseCandidate>& candidates, std::size_t max_fits);
  static std::vector<PoseCandidate> climb_all(const LookFits& fits, const std::vector<PoseCandidate>& candidates);
  bool is_small(const RodModel& rod, const EigenPose& pose) const;
  void look_around(LookFits& fits) const;
  void look_beside(LookFits& fits) const;
  void add_rivals(LookFits& fits, const Detection& detection) const;

  const Levels& levels_;
  const Intrinsics& intrinsics_;
  const std::vector<RodModel>& rods_;
};

}  // namespace onestroke
